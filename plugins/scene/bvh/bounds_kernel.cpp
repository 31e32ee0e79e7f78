// SPDX-License-Identifier: MIT
#include "bounds.hpp"
#include "plugins/common/contact_geometry/body_frame.hpp"

namespace muro::bvh {
namespace {

// hides ::abs and similar functions
using lane::abs, lane::bits, lane::count_of, lane::max, lane::min, lane::Places, lane::V3;

/// Updates as many robots as the scalar has values, beginning with number `first`.
template <class S>
unsigned update_some(const BoundsBatch& batch, int first) {
  const int left = batch.used - first, used = left < count_of<S> ? left : count_of<S>;
  Places<S, double> bounds;
  Places<S> fat_aabbs;
  RobotPoses robots[count_of<S>];
  for (int i = 0; i < count_of<S>; ++i) {
    const int robot = first + (i < used ? i : 0);
    bounds.at[i] = batch.bounds[robot];
    fat_aabbs.at[i] = bounds.at[i] + 6;
    robots[i] = batch.poses[robot];
  }
  V3<S> low{}, high{};
  for (int k = 0; k < batch.box_count; ++k) {
    Places<S> poses;
    const RoundedBox& box = batch.boxes[k];
    for (int i = 0; i < count_of<S>; ++i) poses.at[i] = box.pose.in(robots[i]);
    const contact_geometry::BodyFrame<S> body(poses, true);
    const V3<S> axes[3] = {body.axis(0), body.axis(1), body.axis(2)},
                centre = body.position() + body.rotated(box.centre);
    const auto reach = [&](S x, S y, S z) {
      return abs(x) * S(box.half[0]) + abs(y) * S(box.half[1]) + abs(z) * S(box.half[2]) + S(box.ball);
    };
    const V3<S> half{reach(axes[0].x, axes[1].x, axes[2].x), reach(axes[0].y, axes[1].y, axes[2].y),
                     reach(axes[0].z, axes[1].z, axes[2].z)};
    const V3<S> from = centre - half, to = centre + half;
    low = k == 0 ? from : V3<S>{min(low.x, from.x), min(low.y, from.y), min(low.z, from.z)};
    high = k == 0 ? to : V3<S>{max(high.x, to.x), max(high.y, to.y), max(high.z, to.z)};
  }
  const unsigned all = lane::first_lanes(used);
  lane::store_rows(bounds, 0, {low.x, low.y, low.z, high.x, high.y, high.z}, all);
  S fat_aabb[6];
  lane::load_rows(fat_aabbs, 0, fat_aabb);
  const auto within = (fat_aabb[0] <= low.x) & (fat_aabb[1] <= low.y) & (fat_aabb[2] <= low.z) &  //
                      (high.x <= fat_aabb[3]) & (high.y <= fat_aabb[4]) & (high.z <= fat_aabb[5]);
  return ~bits(within) & all;
}

unsigned update(const BoundsBatch& batch) {
  return lane::in_lanes(batch.used, [&]<class S>(int first, int) { return update_some<S>(batch, first); });
}

}  // namespace

namespace MURO_ISA {
extern const BoundsKernels bounds_kernels;
const BoundsKernels bounds_kernels{&update};
}  // namespace MURO_ISA

}  // namespace muro::bvh
