// SPDX-License-Identifier: MIT
// Driven wheels of a robot that turns by the difference of its left and right wheels.
#pragma once

#include "plugins/common/text/quote.hpp"
#include "wheel_finder.hpp"

namespace muro::wheels {

/// Wheels about an axis along the base's y axis.
struct SideWheels {
  std::vector<Wheel> left, right;
  double track = 0;            ///< m, between the middle of the left and the middle of the right wheels
  Vec3 middle = Vec3::Zero();  ///< m, in the base's frame: half way between these two middles
};

namespace detail {

/// Whether joint and shape of link `i` make it a driven wheel on one side; otherwise `why` gives the reason.
inline bool is_side_wheel(const WheelFinder& finder, std::size_t i, Wheel& wheel, std::string& why) {
  constexpr double cos_tolerance = WheelFinder::cos_tolerance;
  if (!finder.turns_freely(i, why)) return false;
  if (std::abs(finder.axis(i).y()) < cos_tolerance)
    return WheelFinder::reject(why,
                               "turns about " + WheelFinder::to_text(finder.axis(i)) + ", not the y axis, of the base");
  for (std::size_t p = finder.parent(i); p > 0; p = finder.parent(p))
    if (finder.link(p).joint == JointKind::revolute && std::abs(finder.axis(p).y()) < cos_tolerance)
      return WheelFinder::reject(why, "is steered by " + finder.name(p));
  wheel = finder.wheel(i);
  if (!(wheel.radius > 0)) return WheelFinder::reject(why, "has no cylinder or sphere about its axis as a shape");
  if (std::abs(wheel.centre.y()) < 0.01 * wheel.radius)
    return WheelFinder::reject(why, "lies in the middle, neither left nor right");
  return true;
}

inline std::string side_wheels_found(const WheelFinder& finder) {
  return finder.what_was_found([&](std::size_t i, std::string& what) {
    Wheel wheel;
    if (!is_side_wheel(finder, i, wheel, what)) return false;
    what = wheel.centre.y() > 0 ? "is on the left" : "is on the right";
    return true;
  });
}

inline Vec3 mean_centre(const std::vector<Wheel>& wheels) {
  Vec3 sum = Vec3::Zero();
  for (const Wheel& w : wheels) sum += w.centre;
  return sum / double(wheels.size());
}

/// Returns the wheels of both sides: those that are named or, if none is named, those that the model has.
inline SideWheels choose_side_wheels(const WheelFinder& finder, const RobotView& robot, const Parameters& p) {
  const std::span<const std::string_view> left = p.texts(left_wheels.name), right = p.texts(right_wheels.name);
  const double radius = p.real(wheel_radius.name);
  SideWheels wheels;
  if (left.empty() != right.empty())
    throw Error(std::string("`") + (left.empty() ? "right" : "left") + "` names wheels, but `" +
                (left.empty() ? "left" : "right") + "` does not; name the wheels of both sides or of none");
  const auto fits = [](const Vec3& axis) { return std::abs(axis.y()) >= 0.5; };
  for (const std::string_view joint : left) wheels.left.push_back(finder.named(joint, radius, fits, "the y axis"));
  for (const std::string_view joint : right) wheels.right.push_back(finder.named(joint, radius, fits, "the y axis"));
  for (std::size_t i = 1; i < robot.links.size() && left.empty(); ++i) {
    Wheel wheel;
    std::string why;
    if (robot.links[i].joint == JointKind::revolute && is_side_wheel(finder, i, wheel, why))
      (wheel.centre.y() > 0 ? wheels.left : wheels.right).push_back(wheel);
  }
  if (radius > 0)
    for (auto* side : {&wheels.left, &wheels.right})
      for (Wheel& w : *side) w.radius = radius;
  return wheels;
}

}  // namespace detail

/// Returns the driven wheels of `robot`, joints at 0, by the parameters `left`, `right`, `wheel_radius` and `track`.
///
/// Wheels that are not named are joints without limits of position whose axis is parallel to the base's y axis (to 0.1
/// rad) and that carry a cylinder or sphere about this axis; left is y > 0. Casters, steered wheels (a joint about
/// another axis is between them and the base) and joints that follow others are not driven wheels. Throws Error with a
/// list of the model's joints if a side has no wheel or a wheel no radius. [setup]
inline SideWheels find_side_wheels(const Connector& connector, const RobotView& robot) {
  const Parameters& p = connector.parameters();
  const WheelFinder finder(connector, robot);
  SideWheels wheels = detail::choose_side_wheels(finder, robot, p);
  if (wheels.left.empty() || wheels.right.empty())
    throw Error(quote(robot.name) + " has no driven wheels on " +
                (!wheels.left.empty()    ? "the right (y < 0)"
                 : !wheels.right.empty() ? "the left (y > 0)"
                                         : "either side") +
                ": " + detail::side_wheels_found(finder) + ". Name the wheels' joints with `left` and `right`");
  for (const Wheel& l : wheels.left)
    for (const Wheel& r : wheels.right)
      if (l.link == r.link) throw Error("`left` and `right` name the same wheel; each wheel is on one side");
  const Vec3 left = detail::mean_centre(wheels.left), right = detail::mean_centre(wheels.right);
  wheels.middle = 0.5 * (left + right);
  wheels.track = p.real(track.name) > 0 ? p.real(track.name) : left.y() - right.y();
  if (!(wheels.track > 0))
    throw Error("the wheels of `left` lie on the right of those of `right` (their y axis points left): " +
                detail::side_wheels_found(finder));
  return wheels;
}

}  // namespace muro::wheels
