// SPDX-License-Identifier: MIT
#include "reach.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"
#include "muro/vocabulary.hpp"

namespace muro::watch {

namespace {

constexpr double unlimited_turn_rate = 100, unlimited_speed = 10;  ///< rad/s, m/s
constexpr double no_limit = 1e4;                                   ///< rad/s, m/s: models write 1e16 and the like
constexpr double longest_slide = 10;                               ///< m: a longer slide counts as one without a limit

/// m: the smaller of two radii: of a ball with this mass and inertia, and of a ball of air with this mass. Model files
/// hold inertias of 1 kg m^2 for a gram.
double radius_of(const Inertia& inertia) {
  constexpr double air = 1.2;  // kg/m^3
  const double square = (inertia.ixx + inertia.iyy + inertia.izz) / (1.2 * inertia.mass);
  const double by_inertia = square > 0 && std::isfinite(square) ? std::sqrt(square) : 0;
  return inertia.com.norm() + std::min(by_inertia, elementary::cbrt(3 * inertia.mass / (4 * M_PI * air)));
}

double own_reach(const Connector& c, ObjectId link) {
  double reach = 0;
  for (const Shape& s : c.constant_array(link, keys::collision_shapes)) {
    if (s.kind == ShapeKind::plane) continue;
    reach = std::max(reach, s.origin.position.norm() + half_extents(s).norm());
    if (s.kind != ShapeKind::mesh) continue;
    if (const auto inertia = c.constant(link, keys::inertial)) reach = std::max(reach, radius_of(*inertia));
  }
  return reach;
}

/// m: largest distance by which the joint shifts the links that it carries.
double travel_of(const Link& link) {
  if (link.joint != JointKind::prismatic) return 0;
  const double most = std::max(std::abs(link.limits.lower), std::abs(link.limits.upper));
  return most < longest_slide ? most : 0;
}

double joint_speed(const Link& link, double reach) {
  const double limit = link.limits.velocity;
  if (link.joint == JointKind::fixed) return 0;
  if (link.joint == JointKind::prismatic) return limit < no_limit ? limit : unlimited_speed;
  return reach * (limit < no_limit ? limit : unlimited_turn_rate);
}

}  // namespace

Reach reach_of(const Connector& c, const RobotView& robot) {
  Reach reach;
  const std::size_t n = robot.links.size();
  for (const Link& link : robot.links) reach.of_link.push_back(own_reach(c, link.object));
  for (std::size_t i = n; i-- > 1;) {
    const Link& link = robot.links[i];
    double& parent = reach.of_link[std::size_t(link.parent)];
    parent = std::max(parent, link.origin.position.norm() + travel_of(link) + reach.of_link[i]);
  }
  std::vector<double> speeds(n);  // speed of each link by all joints before it
  for (std::size_t i = 1; i < n; ++i) {
    const Link& link = robot.links[i];
    speeds[i] = speeds[std::size_t(link.parent)] + joint_speed(link, reach.of_link[i]);
    reach.drive_speed = std::max(reach.drive_speed, speeds[i]);
  }
  return reach;
}

}  // namespace muro::watch
