// SPDX-License-Identifier: MIT
// Kernels: robots of identical structure against planes and heightmaps of the scenery.
#pragma once

#include "kernel_shape.hpp"
#include "muro/simd/isa.hpp"

namespace muro::native {

/// Number of slots and vertices in one word of a signature. A slot is a pair of a shape and a ground; slots are ordered
/// by body, ground, shape. Six slots share a word, so that the bits of its points (eight a slot) are exact in a double.
/// A hull has its own words, with one bit a vertex.
inline constexpr int slots_per_word = 6, vertices_per_word = 8 * slots_per_word;
/// Most points of one slot. If a hull has more vertices below a plane, the kernel omits the others and reports it.
inline constexpr int max_ground_points = 8;

/// Position of the bits of slots in a signature.
class SignatureCursor {
 public:
  int word() const { return word_; }
  int slot() const { return slot_; }  ///< in the word
  /// Must be called before each slot.
  void begin(const KernelShape& shape) {
    if (shape.kind == KernelShapeKind::mesh && slot_ > 0) next_word();
  }
  /// Must be called after each slot.
  void end(const KernelShape& shape) {
    if (shape.kind == KernelShapeKind::mesh)
      word_ += words_of(shape);
    else if (++slot_ == slots_per_word)
      next_word();
  }
  /// Returns the number of words of a hull.
  static int words_of(const KernelShape& hull) {
    return (hull.vertex_count + vertices_per_word - 1) / vertices_per_word;
  }

 private:
  void next_word() { ++word_, slot_ = 0; }
  int word_ = 0, slot_ = 0;
};
/// Positions of the numbers of a contact: point, normal, depth. The kernel writes the point (0 to 2) and the depth, and
/// on a heightmap also the normal.
inline constexpr int normal_number = 3, depth_number = 6;

/// Numbers that a kernel keeps for a slot with a heightmap and a shape that is not round; see KeptClearance.
inline constexpr int numbers_of_clearance = 8;
/// Returns the number of such slots of a robot.
inline int clearances_of(const KernelShape* shapes, int shape_count, const Ground* grounds, int ground_count) {
  int count = 0;
  for (int g = 0; g < ground_count; ++g)
    for (int k = 0; k < shape_count; ++k) count += grounds[g].terrain && !shapes[k].is_round();
  return count;
}

/// Input and output of one call for at most eight robots.
struct GroundBatch {
  const KernelShape* shapes = nullptr;  ///< of each robot, body by body
  int shape_count = 0;
  const Ground* grounds = nullptr;
  int ground_count = 0;
  int contact_stride = 0;  ///< in numbers
  int used = 0;            ///< robots
  RobotPoses poses[8];
  double* contacts[8];    ///< of each robot: the numbers of its first contact
  double* signatures[8];  ///< of each robot, a bit a point that touches: of the step before, then of this step
  /// Clearances of each robot from earlier steps: numbers_of_clearance for each slot with a heightmap and a shape that
  /// is not round. All are 0 at first, and after a ground has changed.
  double* clearances[8];
  /// One byte for each slot, all 0 before the call. Has a bit for each robot for which the kernel cannot find the
  /// points of the slot. Points that it has given there do not count.
  std::uint8_t* left = nullptr;
};

/// Returns the number of slots of a robot.
inline int slots_of(int shape_count, int ground_count) { return shape_count * ground_count; }

/// Returns the number of words of a signature; the last one may be empty. `shapes`: body by body.
inline int words_of(const KernelShape* shapes, int shape_count, int grounds) {
  SignatureCursor cursor;
  for (int begin = 0, end = 0; begin < shape_count; begin = end) {
    while (end < shape_count && shapes[end].body == shapes[begin].body) ++end;
    for (int ground = 0; ground < grounds; ++ground)
      for (int k = begin; k < end; ++k) cursor.begin(shapes[k]), cursor.end(shapes[k]);
  }
  return cursor.word() + 1;
}

/// Writes the signatures and the contacts, ordered by body, ground, shape and number of the point. The list of a robot
/// needs capacity for eight contacts a slot. Returns a bit for each robot whose signature has changed. Eight bits
/// higher it returns a bit for each robot with a slot that needs more than a kernel can do: a hull with more than eight
/// vertices below a plane, or a shape on a heightmap whose points TerrainPoints cannot find.
struct GroundKernels {
  unsigned (*find_contacts)(const GroundBatch&);
};
MURO_DECLARE_KERNELS(GroundKernels, ground_kernels)

}  // namespace muro::native
