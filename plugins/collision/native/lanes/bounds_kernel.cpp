// SPDX-License-Identifier: MIT
#include "bounds.hpp"

namespace muro::native {
namespace {

using namespace lanes;

/// As many robots as the scalar has values, from number `first` on.
template <class S>
unsigned bound_some(const BoundsWork& work, int first) {
  const int left = work.used - first, used = left < count_of<S> ? left : count_of<S>;
  Places<S, double> boxes;
  Places<S> rooms;
  const double* const* bodies[count_of<S>];
  for (int i = 0; i < count_of<S>; ++i) {
    const int robot = first + (i < used ? i : 0);
    boxes.at[i] = work.boxes[robot];
    rooms.at[i] = boxes.at[i] + 6;
    bodies[i] = work.poses[robot];
  }
  V3<S> low{}, high{};
  for (int k = 0; k < work.part_count; ++k) {
    Places<S> poses;
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = bodies[i][k];
    const Body<S> body = load_body(poses);
    const Part& part = work.parts[k];
    const V3<S> centre = body.position + body.turned(part.centre);
    const auto reach = [&](S x, S y, S z) {
      return abs(x) * S(part.half[0]) + abs(y) * S(part.half[1]) + abs(z) * S(part.half[2]) + S(part.ball);
    };
    const V3<S> half{reach(body.axes[0].x, body.axes[1].x, body.axes[2].x),
                     reach(body.axes[0].y, body.axes[1].y, body.axes[2].y),
                     reach(body.axes[0].z, body.axes[1].z, body.axes[2].z)};
    const V3<S> from = centre - half, to = centre + half;
    low = k == 0 ? from : V3<S>{min(low.x, from.x), min(low.y, from.y), min(low.z, from.z)};
    high = k == 0 ? to : V3<S>{max(high.x, to.x), max(high.y, to.y), max(high.z, to.z)};
  }
  const unsigned robots = (1u << used) - 1;
  lane::store_rows(boxes, 0, {low.x, low.y, low.z, high.x, high.y, high.z}, robots);
  S room[6];
  lane::load_rows(rooms, 0, room);
  const auto within = (room[0] <= low.x) & (room[1] <= low.y) & (room[2] <= low.z) &  //
                      (high.x <= room[3]) & (high.y <= room[4]) & (high.z <= room[5]);
  return ~bits(within) & robots;
}

/// A lane costs about as much as three plain doubles.
unsigned bound(const BoundsWork& work) {
  if (work.used >= 3) return bound_some<lane::Double8>(work, 0);
  unsigned outside = 0;
  for (int first = 0; first < work.used; ++first) outside |= bound_some<double>(work, first) << first;
  return outside;
}

}  // namespace

namespace MURO_ISA {
extern const BoundsKernels bounds_kernels;
const BoundsKernels bounds_kernels{&bound};
}  // namespace MURO_ISA

}  // namespace muro::native
