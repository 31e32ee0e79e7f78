// SPDX-License-Identifier: MIT
#include "moved_inertias.hpp"

#include <algorithm>

#include "muro/toolkit/link_pose.hpp"

namespace muro {

MovedInertias::Composite MovedInertias::Composite::without(const Composite& part) const {
  return {mass - part.mass, first_moment - part.first_moment, second_moment - part.second_moment};
}

double MovedInertias::Composite::along(JointKind kind, const Placed& placed) const {
  if (kind == JointKind::prismatic) return std::max(mass, 0.0);
  if (kind == JointKind::fixed) return 0;
  // about a parallel axis through a point p: the sum of m |a x (r - p)|^2
  const Vec3 arm = placed.joint - placed.axis * placed.axis.dot(placed.joint);
  const double about_origin = placed.axis.dot(second_moment * placed.axis);
  return std::max(about_origin - 2 * arm.dot(first_moment) + mass * arm.squaredNorm(), 0.0);
}

MovedInertias::MovedInertias(std::vector<Body> bodies, bool fixed_base)
    : fixed_base_(fixed_base),
      bodies_(std::move(bodies)),
      poses_(bodies_.size()),
      placed_(bodies_.size()),
      composites_(bodies_.size()),
      moved_(bodies_.size()) {}

void MovedInertias::update(std::span<const double> positions) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto& [link, inertia] = bodies_[i];
    if (i > 0) poses_[i] = poses_[std::size_t(link.parent)] * pose_in_parent(link, positions[i]);
    const Mat3 rotation = poses_[i].orientation.toRotationMatrix();
    place(i, {poses_[i].position, rotation * link.axis, poses_[i].position + rotation * inertia.com,
              rotation * inertia.tensor() * rotation.transpose()});
  }
  find();
}

void MovedInertias::place(std::size_t body, const Placed& placed) {
  const double mass = bodies_[body].inertia.mass;
  const Vec3& r = placed.centre;
  Composite& c = composites_[body];
  placed_[body] = placed;
  c.mass = mass;
  c.first_moment = mass * r;
  c.second_moment = placed.tensor + mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

void MovedInertias::find() {
  for (std::size_t i = bodies_.size() - 1; i > 0; --i) {
    Composite& on = composites_[std::size_t(bodies_[i].link.parent)];
    on.mass += composites_[i].mass;
    on.first_moment += composites_[i].first_moment;
    on.second_moment += composites_[i].second_moment;
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const JointKind kind = bodies_[i].link.joint;
    const double behind = composites_[i].along(kind, placed_[i]), armature = bodies_[i].link.limits.armature;
    if (fixed_base_) {
      moved_[i] = {behind + armature, behind + armature};
      continue;
    }
    const double before = composites_[0].without(composites_[i]).along(kind, placed_[i]), sum = behind + before;
    moved_[i] = {std::max(behind, before) + armature, (sum > 0 ? behind * before / sum : 0) + armature};
  }
}

}  // namespace muro
