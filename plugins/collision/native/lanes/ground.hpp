// SPDX-License-Identifier: MIT
// Kernels: robots of identical structure against planes and heightmaps of the scenery.
#pragma once

#include "kernel_shape.hpp"
#include "muro/simd/isa.hpp"

namespace muro::native {

/// A slot is a shape and a ground, in the order of body, ground, shape. Six slots share one word of a signature, so
/// that the bits of its points (eight a slot) are exact in a double. A hull has words of its own, a bit a vertex.
inline constexpr int slots_per_word = 6, vertices_per_word = 8 * slots_per_word;
/// Of one slot: of a hull that has more below a plane the kernel leaves the rest out, and says so.
inline constexpr int max_ground_points = 8;

/// Where the bits of slots are in a signature.
class SignatureCursor {
 public:
  int word() const { return word_; }
  int slot() const { return slot_; }  ///< in the word
  /// To be called before a slot.
  void begin(const KernelShape& shape) {
    if (shape.kind == KernelShapeKind::mesh && slot_ > 0) next_word();
  }
  /// To be called behind it.
  void end(const KernelShape& shape) {
    if (shape.kind == KernelShapeKind::mesh)
      word_ += words_of(shape);
    else if (++slot_ == slots_per_word)
      next_word();
  }
  /// Of a hull.
  static int words_of(const KernelShape& hull) {
    return (hull.vertex_count + vertices_per_word - 1) / vertices_per_word;
  }

 private:
  void next_word() { ++word_, slot_ = 0; }
  int word_ = 0, slot_ = 0;
};
/// A contact's numbers: point, normal, depth; of which the kernel writes the point (0 to 2), the depth, and on a
/// heightmap the normal.
inline constexpr int normal_number = 3, depth_number = 6;

/// What a kernel keeps of a slot of a shape that is not round on a heightmap; see KeptClearance.
inline constexpr int numbers_of_clearance = 8;
/// How many such slots a robot has.
inline int clearances_of(const KernelShape* shapes, int shape_count, const Ground* grounds, int ground_count) {
  int count = 0;
  for (int g = 0; g < ground_count; ++g)
    for (int k = 0; k < shape_count; ++k) count += grounds[g].terrain && !shapes[k].is_round();
  return count;
}

/// The input and output of one call: at most eight robots.
struct GroundBatch {
  const KernelShape* shapes = nullptr;  ///< of each robot, body by body
  int shape_count = 0;
  const Ground* grounds = nullptr;
  int ground_count = 0;
  int contact_stride = 0;  ///< in numbers
  int used = 0;            ///< robots
  RobotPoses poses[8];
  double* contacts[8];    ///< of each robot: the numbers of its first contact
  double* signatures[8];  ///< of each robot, a bit a point that touches: of the step before, then of this one
  /// Of each robot: what is known of earlier steps, numbers_of_clearance for each slot of a shape that is not round on
  /// a heightmap; all 0 at first, and where a ground has changed.
  double* clearances[8];
  /// A byte a slot, all 0 before: a bit for each robot of whose slot the kernel cannot tell the points. Those that it
  /// has given there do not count.
  std::uint8_t* left = nullptr;
};

/// Slots of a robot.
inline int slots_of(int shape_count, int ground_count) { return shape_count * ground_count; }

/// How many words a signature has; the last may be empty. `shapes`: body by body.
inline int words_of(const KernelShape* shapes, int shape_count, int grounds) {
  SignatureCursor cursor;
  for (int begin = 0, end = 0; begin < shape_count; begin = end) {
    while (end < shape_count && shapes[end].body == shapes[begin].body) ++end;
    for (int ground = 0; ground < grounds; ++ground)
      for (int k = begin; k < end; ++k) cursor.begin(shapes[k]), cursor.end(shapes[k]);
  }
  return cursor.word() + 1;
}

/// Writes contacts ordered by body, ground, shape and number of the point, and the signatures. The list of a robot
/// needs capacity for eight contacts a slot. Returns a bit for each robot whose signature has changed, and, eight bits
/// higher, one for each robot with a slot that needs more than a kernel can do: of a hull that has more than eight
/// vertices below a plane, or of a shape on a heightmap whose points TerrainPoints cannot tell.
struct GroundKernels {
  unsigned (*find_contacts)(const GroundBatch&);
};
MURO_DECLARE_KERNELS(GroundKernels, ground_kernels)

}  // namespace muro::native
