// SPDX-License-Identifier: MIT
#include "lanes/ground.hpp"
#include "lanes/plane_points.hpp"

namespace muro::native {
namespace {

using namespace lanes;

/// Appends contacts to those of their robots.
template <class S>
struct Appender {
  Places<S, double> next{};
  const int stride;
  const unsigned used;  ///< a bit a robot
  // of the present slot:
  V3<S> normal{};
  S friction{}, bits_of_points{};
  double scale = 0;  ///< of the slot in its word

  MURO_INLINE void operator()(MaskOf<S> below, const V3<S>& point, S depth, int number) {
    const unsigned which = bits(below) & used;
    bits_of_points += select(below, S(scale * (1 << number)), S(0));
    store_rows(next, {point.x, point.y, point.z, normal.x, normal.y, normal.z, depth, friction}, which);
    for (int i = 0; i < count_of<S>; ++i) next.at[i] += which >> i & 1 ? stride : 0;
  }
};

/// Robots `first` to `first` + count_of<S> - 1, as far as there are so many.
template <class S>
void touch_some(const GroundWork& work, int first) {
  const int left = work.used - first, used = left < count_of<S> ? left : count_of<S>;
  const auto robot = [&](int i) { return first + (i < used ? i : 0); };
  Appender<S> append{.stride = work.contact_stride, .used = (1u << used) - 1};
  for (int i = 0; i < count_of<S>; ++i) append.next.at[i] = work.contacts[robot(i)];
  for (int word = 0; word * slots_of_word < work.plane_count * work.solid_count; ++word)
    for (int i = 0; i < used; ++i) work.signatures[word * work.used + first + i] = 0;

  for (int begin = 0, end = 0; begin < work.solid_count; begin = end) {
    Places<S> poses;
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = work.poses[robot(i)][begin];
    const Turned<S> body = load_turned(poses);
    while (end < work.solid_count && work.solids[end].body == work.solids[begin].body) ++end;
    for (int p = 0; p < work.plane_count; ++p) {
      const double* const numbers = work.planes + 6 * p;
      const Plane<S> plane{lane::splat<S>(numbers), lane::splat<S>(numbers + 3)};
      append.normal = plane.normal;
      for (int k = begin; k < end; ++k) {
        const int slot = p * work.solid_count + k;
        append.friction = S(work.friction[slot]);
        append.scale = double(1ull << 8 * (slot % slots_of_word));
        append.bits_of_points = S(0);
        const Turned<S> solid = place(work.solids[k], body);
        PlanePoints<S>(work.solids[k], solid, plane).give(append);
        double* const word = work.signatures + slot / slots_of_word * work.used + first;
        if constexpr (count_of<S> == 1) {
          word[0] += append.bits_of_points;
        } else {
          for (int i = 0; i < used; ++i) word[i] += append.bits_of_points[i];
        }
      }
    }
  }
}

/// A lane costs about as much as three plain doubles.
void touch(const GroundWork& work) {
  using Lane = lane::Double8;
  int first = 0;
  for (; work.used - first >= 3; first += count_of<Lane>) touch_some<Lane>(work, first);
  for (; first < work.used; ++first) touch_some<double>(work, first);
}

}  // namespace

namespace MURO_ISA {
extern const GroundKernels ground_kernels;
const GroundKernels ground_kernels{&touch};
}  // namespace MURO_ISA

}  // namespace muro::native
