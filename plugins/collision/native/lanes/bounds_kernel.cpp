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
  Poses robots[count_of<S>];
  for (int i = 0; i < count_of<S>; ++i) {
    const int robot = first + (i < used ? i : 0);
    boxes.at[i] = work.boxes[robot];
    rooms.at[i] = boxes.at[i] + 6;
    robots[i] = work.poses[robot];
  }
  V3<S> low{}, high{};
  for (int k = 0; k < work.part_count; ++k) {
    Places<S> poses;
    const Part& part = work.parts[k];
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = part.pose.in(robots[i]);
    const Body<S> body(poses, true);
    const V3<S> axes[3] = {body.axis(0), body.axis(1), body.axis(2)},
                centre = body.position() + body.turned(part.centre);
    const auto reach = [&](S x, S y, S z) {
      return abs(x) * S(part.half[0]) + abs(y) * S(part.half[1]) + abs(z) * S(part.half[2]) + S(part.ball);
    };
    const V3<S> half{reach(axes[0].x, axes[1].x, axes[2].x), reach(axes[0].y, axes[1].y, axes[2].y),
                     reach(axes[0].z, axes[1].z, axes[2].z)};
    const V3<S> from = centre - half, to = centre + half;
    low = k == 0 ? from : V3<S>{min(low.x, from.x), min(low.y, from.y), min(low.z, from.z)};
    high = k == 0 ? to : V3<S>{max(high.x, to.x), max(high.y, to.y), max(high.z, to.z)};
  }
  const unsigned all = lane::first_lanes(used);
  lane::store_rows(boxes, 0, {low.x, low.y, low.z, high.x, high.y, high.z}, all);
  S room[6];
  lane::load_rows(rooms, 0, room);
  const auto within = (room[0] <= low.x) & (room[1] <= low.y) & (room[2] <= low.z) &  //
                      (high.x <= room[3]) & (high.y <= room[4]) & (high.z <= room[5]);
  return ~bits(within) & all;
}

unsigned bound(const BoundsWork& work) {
  return lane::in_lanes(work.used, [&]<class S>(int first, int) { return bound_some<S>(work, first); });
}

}  // namespace

namespace MURO_ISA {
extern const BoundsKernels bounds_kernels;
const BoundsKernels bounds_kernels{&bound};
}  // namespace MURO_ISA

}  // namespace muro::native
