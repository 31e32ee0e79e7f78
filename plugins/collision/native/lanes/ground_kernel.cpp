// SPDX-License-Identifier: MIT
#include "ground.hpp"
#include "hull_points.hpp"
#include "terrain_points.hpp"

namespace muro::native {
namespace {

using namespace lanes;

#if defined(__AVX512F__)
/// Row i of the eight by four of x and y, z and depth, which were interleaved by pairs before.
template <int i, class Vector>
MURO_INLINE void store_row(double* to, Vector xy, Vector zd, unsigned which) {
  constexpr int pair = i & 6;
  const Vector row = __builtin_shufflevector(xy, zd, pair, pair + 1, pair + 8, -1, -1, -1, pair + 9, -1);
  static_assert(depth_number == 6);
  if (which >> i & 1) _mm512_mask_storeu_pd(to, __mmask8(7 | 1 << depth_number), __m512d(row));
}
#endif

/// The numbers of a contact that change, to those places whose bit is set in `which`, from number `first` on.
template <class S>
MURO_INLINE void store_contacts(const Places<S, double>& to, std::int64_t first, const V3<S>& point, S depth,
                                unsigned which) {
#if defined(__AVX512F__)
  if constexpr (count_of<S> == 8) {
    const auto xy0 = __builtin_shufflevector(point.x.v, point.y.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto xy1 = __builtin_shufflevector(point.x.v, point.y.v, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto zd0 = __builtin_shufflevector(point.z.v, depth.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto zd1 = __builtin_shufflevector(point.z.v, depth.v, 1, 9, 3, 11, 5, 13, 7, 15);
    store_row<0>(to.at[0] + first, xy0, zd0, which);
    store_row<1>(to.at[1] + first, xy1, zd1, which);
    store_row<2>(to.at[2] + first, xy0, zd0, which);
    store_row<3>(to.at[3] + first, xy1, zd1, which);
    store_row<4>(to.at[4] + first, xy0, zd0, which);
    store_row<5>(to.at[5] + first, xy1, zd1, which);
    store_row<6>(to.at[6] + first, xy0, zd0, which);
    store_row<7>(to.at[7] + first, xy1, zd1, which);
    return;
  }
#endif
  const auto value = [](S s, [[maybe_unused]] int i) {
    if constexpr (count_of<S> == 1)
      return s;
    else
      return s[i];
  };
  for (int i = 0; i < count_of<S>; ++i)
    if (which >> i & 1) {
      double* const contact = to.at[i] + first;
      contact[0] = value(point.x, i);
      contact[1] = value(point.y, i);
      contact[2] = value(point.z, i);
      contact[depth_number] = value(depth, i);
    }
}

/// Appends contacts to those of their robots.
template <class S>
struct Appender {
  const int stride;
  const unsigned all;         ///< a bit a robot
  Places<S, double> first{};  ///< `next` numbers behind it a robot's next contact begins
  std::int64_t next = 0;
  S points{0};       ///< the present word of the signature
  double scale = 1;  ///< of the present slot in it

  MURO_INLINE void operator()(MaskOf<S> below, const V3<S>& point, S depth, int number) {
    points += select(below, S(scale * double(std::int64_t(1) << number)), S(0));
    const unsigned which = bits(below) & all;
    if (which == lane::all_lanes<S>)
      store_contacts(first, next, point, depth, lane::all_lanes<S>);
    else
      append_some(point, depth, which);
    next += stride;
  }

  /// On a heightmap.
  MURO_INLINE void operator()(MaskOf<S> below, const V3<S>& point, const V3<S>& normal, S depth, int number) {
    static_assert(normal_number == 3 && depth_number == 6);
    points += select(below, S(scale * double(std::int64_t(1) << number)), S(0));
    const unsigned which = bits(below) & all;
    lane::store_rows(first, next, {point.x, point.y, point.z, normal.x, normal.y, normal.z, depth}, which);
    for (int i = 0; i < count_of<S>; ++i) first.at[i] -= which >> i & 1 ? 0 : stride;
    next += stride;
  }

  /// Out of the way of the common case.
  [[gnu::noinline]] void append_some(const V3<S>& point, const S& depth, unsigned which) {
    store_contacts(first, next, point, depth, which);
    for (int i = 0; i < count_of<S>; ++i) first.at[i] -= which >> i & 1 ? 0 : stride;
  }
};

/// As many robots as the scalar has values, from number `first` on. Returns what GroundKernels does.
template <class S>
unsigned process(const GroundBatch& batch, int first) {
  const int rest = batch.used - first, used = rest < count_of<S> ? rest : count_of<S>;
  RobotPoses robots[count_of<S>];
  Places<S, double> signatures;
  Appender<S> append{.stride = batch.contact_stride, .all = lane::first_lanes(used)};
  for (int i = 0; i < count_of<S>; ++i) {
    const int robot = first + (i < used ? i : 0);
    robots[i] = batch.poses[robot];
    append.first.at[i] = batch.contacts[robot];
    signatures.at[i] = batch.signatures[robot];
  }
  unsigned changed = 0, left_over = 0;
  int word = 0, slot = 0;  // of the present word
  int slot_number = 0;     // of all slots
  const auto leave = [&](MaskOf<S> whose) {
    const unsigned now = bits(whose) & append.all;
    if (now == 0) return;
    left_over |= now;
    batch.left[slot_number] = std::uint8_t(batch.left[slot_number] | now << first);
  };
  const auto end_word = [&] {
    const unsigned now = ~bits(load(as_read(signatures), word) == append.points) & append.all;
    if (now != 0) lane::store_rows(signatures, word, {append.points}, now);
    changed |= now;
    append.points = S(0);
    append.scale = 1;
    slot = 0;
    ++word;
  };
  const auto add_hull = [&](const KernelShape& hull, const BodyFrame<S>& body, const GroundPlane& plane) {
    if (slot > 0) end_word();
    int first_of_word = 0;
    S count(0);
    const auto sink = [&](MaskOf<S> below, const V3<S>& point, S depth, int number) {
      for (; number >= first_of_word + vertices_per_word; first_of_word += vertices_per_word) end_word();
      const MaskOf<S> fits = below & (count < S(max_ground_points));
      count += select(below, S(1), S(0));
      if (any(fits)) append(fits, point, depth, number - first_of_word);
    };
    lanes::give_hull_points<S>(hull, body, plane, sink);
    for (; first_of_word < hull.vertex_count; first_of_word += vertices_per_word) end_word();
    leave(count > S(max_ground_points));
  };
  const auto add_terrain = [&](const KernelShape& shape, const BodyFrame<S>& body, const TerrainGrid& terrain) {
    if (shape.kind == KernelShapeKind::mesh && slot > 0) end_word();
    leave(lanes::give_terrain_points<S>(ShapeInWorld<S>(shape, body), terrain, append));
    for (int w = 0; shape.kind == KernelShapeKind::mesh && w < SignatureCursor::words_of(shape); ++w) end_word();
  };
  const KernelShape* const shapes_end = batch.shapes + batch.shape_count;
  for (const KernelShape *begin = batch.shapes, *end = begin; begin != shapes_end; begin = end) {
    bool needs_orientation = false;
    for (; end != shapes_end && end->body == begin->body; ++end)
      needs_orientation = needs_orientation || end->needs_orientation();
    Places<S> poses;
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = begin->pose.in(robots[i]);
    const BodyFrame<S> body(poses, needs_orientation);
    for (const Ground* ground = batch.grounds; ground != batch.grounds + batch.ground_count; ++ground)
      for (const KernelShape* shape = begin; shape != end; ++shape, ++slot_number) {
        if (ground->terrain) add_terrain(*shape, body, *ground->terrain);
        if (shape->kind == KernelShapeKind::mesh) {
          if (!ground->terrain) add_hull(*shape, body, ground->plane);
          continue;
        }
        if (!ground->terrain) give_plane_points<S>(ShapeInWorld<S>(*shape, body), ground->plane, append);
        append.scale *= 256;
        if (++slot == slots_per_word) end_word();
      }
  }
  end_word();
  return changed | left_over << 8;
}

unsigned find_contacts(const GroundBatch& batch) {
  return lane::in_lanes(batch.used, [&]<class S>(int first, int) { return process<S>(batch, first); });
}

}  // namespace

namespace MURO_ISA {
extern const GroundKernels ground_kernels;
const GroundKernels ground_kernels{&find_contacts};
}  // namespace MURO_ISA

}  // namespace muro::native
