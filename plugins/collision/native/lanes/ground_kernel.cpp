// SPDX-License-Identifier: MIT
#include "ground.hpp"
#include "hull_points.hpp"
#include "kept_clearance.hpp"
#include "terrain_points.hpp"

namespace muro::native {
namespace {

using namespace lanes;

#if defined(__AVX512F__)
/// Stores row i of a table of eight rows and four columns (x, y, z, depth). Pairs xy and zd are interleaved before.
template <int i, class Vector>
MURO_INLINE void store_row(double* to, Vector xy, Vector zd, unsigned which) {
  constexpr int pair = i & 6;
  const Vector row = __builtin_shufflevector(xy, zd, pair, pair + 1, pair + 8, -1, -1, -1, pair + 9, -1);
  static_assert(depth_number == 6);
  if (which >> i & 1) _mm512_mask_storeu_pd(to, __mmask8(7 | 1 << depth_number), __m512d(row));
}
#endif

/// Stores the numbers of a contact that change, from number `first` on, to the places whose bit is set in `which`.
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

/// Stores seven numbers to each place, from number `first` on.
template <class S>
MURO_INLINE void store_sevens(const Places<S, double>& to, std::int64_t first, const S (&v)[7]) {
#if defined(__AVX512F__)
  if constexpr (count_of<S> == 8) {
    __m512d pairs[8];  // numbers 2 k and 2 k + 1, of lanes 0, 2, 4, 6, and of 1, 3, 5, 7
    for (int k = 0; k < 4; ++k) {
      const __m512d a(v[2 * k].v), b(v[k < 3 ? 2 * k + 1 : 6].v);
      pairs[k] = _mm512_unpacklo_pd(a, b), pairs[4 + k] = _mm512_unpackhi_pd(a, b);
    }
    for (int odd = 0; odd < 2; ++odd) {
      const __m512d* const p = pairs + 4 * odd;
      const __m512d a = _mm512_shuffle_f64x2(p[0], p[1], 0x88), b = _mm512_shuffle_f64x2(p[0], p[1], 0xdd),
                    c = _mm512_shuffle_f64x2(p[2], p[3], 0x88), d = _mm512_shuffle_f64x2(p[2], p[3], 0xdd);
      const auto store = [&](int lane, __m512d row) { _mm512_mask_storeu_pd(to.at[lane + odd] + first, 0x7f, row); };
      store(0, _mm512_shuffle_f64x2(a, c, 0x88)), store(4, _mm512_shuffle_f64x2(a, c, 0xdd));
      store(2, _mm512_shuffle_f64x2(b, d, 0x88)), store(6, _mm512_shuffle_f64x2(b, d, 0xdd));
    }
    return;
  }
#endif
  lane::store_rows(to, first, v);
}

/// Appends contacts to the lists of their robots.
template <class S>
struct Appender {
  const int stride;
  const unsigned all;         ///< one bit for each robot
  Places<S, double> first{};  ///< a robot's next contact begins `next` numbers after it
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

  /// Appends on a heightmap, where robots differ in what touches. All lanes write. A robot without a contact here
  /// overwrites it with its next one. Lanes beyond `all` do what the first robot does.
  MURO_INLINE void operator()(MaskOf<S> below, const V3<S>& point, const V3<S>& normal, S depth, int number) {
    static_assert(normal_number == 3 && depth_number == 6);
    points += select(below, S(scale * double(std::int64_t(1) << number)), S(0));
    store_sevens(first, next, {point.x, point.y, point.z, normal.x, normal.y, normal.z, depth});
    std::int64_t moves[count_of<S>];
    store_whole(moves, select(below, S(stride), S(0)));
    for (int i = 0; i < count_of<S>; ++i) first.at[i] += moves[i];
  }

  /// Handles the rare case that not all lanes have the contact.
  [[gnu::noinline]] void append_some(const V3<S>& point, const S& depth, unsigned which) {
    store_contacts(first, next, point, depth, which);
    for (int i = 0; i < count_of<S>; ++i) first.at[i] -= which >> i & 1 ? 0 : stride;
  }
};

/// Processes as many robots as the scalar has values, from number `first` on. Returns the bits of GroundKernels.
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
  int word = 0, slot = 0;  // `slot`: in the present word
  int slot_number = 0;     // among all slots
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
  std::int64_t kept_number = 0;  // among a robot's clearances
  /// Handles a shape for which the kernel can only find whether it is above the ground.
  const auto look_at_clearance = [&](const KernelShape& shape, const BodyFrame<S>& body, const TerrainGrid& terrain) {
    Places<S, double> kept;
    for (int i = 0; i < count_of<S>; ++i)
      kept.at[i] = batch.clearances[first + (i < used ? i : 0)] + kept_number * numbers_of_clearance;
    ++kept_number;
    const lanes::KeptClearance<S> known(kept, body, shape.reach());
    const unsigned stale = ~bits(known.still_clear()) & append.all;
    if (stale == 0) return;
    const ShapeInWorld<S> at(shape, body);
    const S far = lanes::ShapeClearance<S, ShapeInWorld<S>>(at, terrain).find(!known.still_clear());
    known.keep(far, stale);
    leave(!(far >= S(0)));
  };
  const auto add_hull = [&](const KernelShape& hull, const BodyFrame<S>& body, const Ground& ground) {
    if (slot > 0) end_word();
    int first_of_word = 0;
    S count(0);
    const auto sink = [&](MaskOf<S> below, const V3<S>& point, S depth, int number) {
      for (; number >= first_of_word + vertices_per_word; first_of_word += vertices_per_word) end_word();
      const MaskOf<S> fits = below & (count < S(max_ground_points));
      count += select(below, S(1), S(0));
      if (any(fits)) append(fits, point, depth, number - first_of_word);
    };
    if (ground.terrain)
      look_at_clearance(hull, body, *ground.terrain);
    else
      lanes::give_hull_points<S>(hull, body, ground.plane, sink);
    for (; first_of_word < hull.vertex_count; first_of_word += vertices_per_word) end_word();
    leave(count > S(max_ground_points));
  };
  const auto end_slot = [&] {
    append.scale *= 256;
    ++slot_number;
    if (++slot == slots_per_word) end_word();
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
      for (const KernelShape* shape = begin; shape != end; ++shape) {
        if (shape->kind == KernelShapeKind::mesh) {
          add_hull(*shape, body, *ground);
          ++slot_number;
          continue;
        }
        if (ground->terrain && shape->is_round())
          leave(lanes::give_terrain_points<S>(ShapeInWorld<S>(*shape, body), *ground->terrain, append));
        else if (ground->terrain)
          look_at_clearance(*shape, body, *ground->terrain);
        else
          give_plane_points<S>(ShapeInWorld<S>(*shape, body), ground->plane, append);
        end_slot();
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
