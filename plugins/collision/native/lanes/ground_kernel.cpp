// SPDX-License-Identifier: MIT
#include "lanes/ground.hpp"
#include "lanes/plane_points.hpp"

namespace muro::native {
namespace {

using namespace lanes;

/// The changing numbers of a contact, from number `first` on of each place whose bit is set in `which`.
template <class S>
MURO_INLINE void store_contacts(const Places<S, double>& to, std::int64_t first, const V3<S>& point, S depth,
                                unsigned which) {
#if defined(__AVX512F__)
  if constexpr (count_of<S> == 8) {
    constexpr auto mask = __mmask8(7 | 1 << depth_number);
    const auto xy0 = __builtin_shufflevector(point.x.v, point.y.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto xy1 = __builtin_shufflevector(point.x.v, point.y.v, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto zd0 = __builtin_shufflevector(point.z.v, depth.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto zd1 = __builtin_shufflevector(point.z.v, depth.v, 1, 9, 3, 11, 5, 13, 7, 15);
#define MURO_STORE_ROW(i, xy, zd)                                                                            \
  if (which >> (i)&1)                                                                                        \
  _mm512_mask_storeu_pd(to.at[i] + first, mask,                                                              \
                        __m512d(__builtin_shufflevector(xy, zd, (i)&6, (i) | 1, ((i)&6) + 8, -1, -1, -1, \
                                                        ((i) | 1) + 8, -1)))
    MURO_STORE_ROW(0, xy0, zd0);
    MURO_STORE_ROW(1, xy1, zd1);
    MURO_STORE_ROW(2, xy0, zd0);
    MURO_STORE_ROW(3, xy1, zd1);
    MURO_STORE_ROW(4, xy0, zd0);
    MURO_STORE_ROW(5, xy1, zd1);
    MURO_STORE_ROW(6, xy0, zd0);
    MURO_STORE_ROW(7, xy1, zd1);
#undef MURO_STORE_ROW
    return;
  }
#endif
}

/// Appends contacts to those of their robots.
template <class S>
struct Appender {
  const int stride;
  const unsigned all;          ///< a bit a robot
  Places<S, double> first{};   ///< `next` numbers behind it a robot's next contact begins
  std::int64_t next = 0;
  S points{0};       ///< the present word of the signature
  double scale = 1;  ///< of the present slot in it

  MURO_INLINE void operator()(MaskOf<S> below, const V3<S>& point, S depth, int number) {
    points += select(below, S(scale * (1 << number)), S(0));
    const unsigned which = bits(below) & all;
    if (which == (1u << count_of<S>) - 1) {
      store_contacts(first, next, point, depth, (1u << count_of<S>) - 1);
    } else {
      store_contacts(first, next, point, depth, which);
      for (int i = 0; i < count_of<S>; ++i) first.at[i] -= which >> i & 1 ? 0 : stride;
    }
    next += stride;
  }
};

/// As many robots as the scalar has values, from number `first` on.
template <class S>
void touch_some(const GroundWork& work, int first) {
  const int left = work.used - first, used = left < count_of<S> ? left : count_of<S>;
  const double* const* bodies[count_of<S>];
  Appender<S> append{.stride = work.contact_stride, .all = (1u << used) - 1};
  for (int i = 0; i < count_of<S>; ++i) {
    const int robot = first + (i < used ? i : 0);
    bodies[i] = work.poses[robot];
    append.first.at[i] = work.contacts[robot];
  }
  double* signature = work.signatures + first;
  int slot = 0;  // of the present word
  const Solid* const solids_end = work.solids + work.solid_count;
  for (const Solid *begin = work.solids, *end = begin; begin != solids_end; begin = end) {
    Places<S> poses;
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = bodies[i][begin - work.solids];
    const Body<S> body = load_body(poses);
    while (end != solids_end && end->body == begin->body) ++end;
    for (const Ground* plane = work.planes; plane != work.planes + work.plane_count; ++plane)
      for (const Solid* solid = begin; solid != end; ++solid) {
        const Standing<S> at(*solid, body);
        if (plane->level)
          PlanePoints(at, Plane<S, true>(*plane)).give(append);
        else
          PlanePoints(at, Plane<S, false>(*plane)).give(append);
        append.scale *= 256;
        if (++slot < slots_of_word) continue;
        store_side_by_side(signature, append.points);
        signature += 8;
        append.points = S(0);
        append.scale = 1;
        slot = 0;
      }
  }
  if (slot > 0) store_side_by_side(signature, append.points);
}

/// A lane costs about as much as three plain doubles.
void touch(const GroundWork& work) {
  if (work.used >= 3) return touch_some<lane::Double8>(work, 0);
  for (int first = 0; first < work.used; ++first) touch_some<double>(work, first);
}

}  // namespace

namespace MURO_ISA {
extern const GroundKernels ground_kernels;
const GroundKernels ground_kernels{&touch};
}  // namespace MURO_ISA

}  // namespace muro::native
