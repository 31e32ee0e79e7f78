// SPDX-License-Identifier: MIT
// Wheels of a vehicle that can move in every direction: mecanum wheels and omni wheels.
#pragma once

#include <algorithm>
#include <numbers>

#include "muro/base/number_text.hpp"
#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/quote.hpp"
#include "wheel_finder.hpp"

namespace muro::wheels {

/// A wheel with rollers on its circumference.
struct OmniWheel : Wheel {
  /// Angle, rad, -pi/2 .. pi/2, about the base's z axis: from the direction in which the wheel rolls (forward or to the
  /// left, whatever the sense of its joint) to the axis of the roller on the ground. 0: an omni wheel, whose rollers
  /// turn about its circumference; +-pi/4: a mecanum wheel.
  double roller_angle = 0;
  Vec3 heading = Vec3::UnitX();  ///< unit, in the base's frame: rolling direction of a positive joint velocity
};

namespace detail {

inline bool is_omni_wheel(const WheelFinder& finder, std::size_t i, OmniWheel& wheel, std::string& why) {
  if (!finder.turns_freely(i, why)) return false;
  if (std::abs(finder.axis(i).z()) > WheelFinder::sin_tolerance)
    return WheelFinder::reject(
        why, "turns about " + WheelFinder::to_text(finder.axis(i)) + ", not a horizontal axis, of the base");
  for (std::size_t p = finder.parent(i); p > 0; p = finder.parent(p))
    if (finder.link(p).joint == JointKind::revolute) {
      if (std::abs(finder.axis(p).z()) > WheelFinder::sin_tolerance)
        return WheelFinder::reject(why, "is steered by " + finder.name(p));
      if (!finder.has_limits(p)) return WheelFinder::reject(why, "is a roller on the wheel of " + finder.name(p));
    }
  static_cast<Wheel&>(wheel) = finder.wheel(i);
  if (!(wheel.radius > 0)) return WheelFinder::reject(why, "has no cylinder or sphere about its axis as a shape");
  return true;
}

inline std::string omni_wheels_found(const WheelFinder& finder) {
  return finder.what_was_found([&](std::size_t i, std::string& what) {
    OmniWheel wheel;
    return is_omni_wheel(finder, i, wheel, what) && (what = "is a wheel", true);
  });
}

/// Returns the wheels that are named or, if none is named, those that the model has.
inline std::vector<OmniWheel> choose_omni_wheels(const WheelFinder& finder, const RobotView& robot,
                                                 const Parameters& p) {
  std::vector<OmniWheel> wheels;
  for (const std::string_view joint : p.texts(all_wheels.name)) {
    OmniWheel wheel;
    const auto fits = [](const Vec3& axis) { return std::abs(axis.z()) <= WheelFinder::sin_tolerance; };
    static_cast<Wheel&>(wheel) = finder.named(joint, p.real(wheel_radius.name), fits, "a horizontal axis");
    for (const OmniWheel& other : wheels)
      if (other.link == wheel.link)
        throw Error("`wheels` names " + finder.name(wheel.link) + " twice; name each wheel once");
    wheels.push_back(wheel);
  }
  for (std::size_t i = 1; i < robot.links.size() && p.texts(all_wheels.name).empty(); ++i) {
    OmniWheel wheel;
    std::string why;
    if (is_omni_wheel(finder, i, wheel, why)) wheels.push_back(wheel);
  }
  return wheels;
}

inline Vec3 middle_of(const std::vector<OmniWheel>& wheels) {
  Vec3 middle = Vec3::Zero();
  for (const OmniWheel& w : wheels) middle += w.centre / double(wheels.size());
  return middle;
}

/// Returns the sign of each wheel's roller angle if four wheels about the y axis are at the corners of a rectangle:
/// seen from above the upper rollers form an X. Empty for other vehicles.
inline std::vector<double> mecanum_signs(const std::vector<OmniWheel>& wheels) {
  const Vec3 middle = middle_of(wheels);
  std::vector<double> signs;
  int quadrants = 0;
  for (const OmniWheel& w : wheels) {
    const Vec3 from_middle = w.centre - middle;
    const bool is_front = from_middle.x() > 0, is_left = from_middle.y() > 0;
    if (std::abs(w.axis.y()) < WheelFinder::cos_tolerance ||
        std::min(std::abs(from_middle.x()), std::abs(from_middle.y())) < 0.1 * w.radius)
      return {};
    quadrants |= 1 << (2 * int(is_front) + int(is_left));
    signs.push_back(is_front == is_left ? -1 : 1);
  }
  return wheels.size() == 4 && quadrants == 15 ? signs : std::vector<double>{};
}

/// Whether the axes of all wheels meet in their middle (to 0.1 rad).
inline bool axes_meet(const std::vector<OmniWheel>& wheels) {
  const Vec3 middle = middle_of(wheels);
  return std::all_of(wheels.begin(), wheels.end(), [&](const OmniWheel& w) {
    Vec3 radial = w.centre - middle;
    radial.z() = 0;
    return std::abs(radial.dot(w.axis)) >= WheelFinder::cos_tolerance * radial.norm();
  });
}

}  // namespace detail

/// Returns the wheels of `robot`, joints at 0, in the order of the parameter `wheels`, or else of the robot's links.
/// Uses the parameters `roller_angle` and `wheel_radius`.
///
/// Wheels that are not named are joints without limits of position about a horizontal axis (to 0.1 rad) that carry a
/// cylinder or sphere about it. They must not hang on another such joint, as rollers do. If no roller angles are given,
/// four wheels about the y axis at the corners of a rectangle are mecanum wheels with +-pi/4. Those on the diagonal
/// front left to rear right have the minus: seen from above the upper rollers form an X. A single given angle replaces
/// pi/4 there. Wheels whose axes meet in their middle are omni wheels with roller angle 0. Throws Error with a list of
/// the model's joints. [setup]
inline std::vector<OmniWheel> find_omni_wheels(const Connector& connector, const RobotView& robot) {
  const Parameters& p = connector.parameters();
  const WheelFinder finder(connector, robot);
  std::vector<OmniWheel> wheels = detail::choose_omni_wheels(finder, robot, p);
  if (wheels.size() < 3)
    throw Error(quote(robot.name) + " has " + counted(wheels.size(), "wheel") +
                ", but three are needed to move in every direction: " + detail::omni_wheels_found(finder) +
                ". Name the wheels' joints with `wheels`");

  const std::span<const double> given = p.reals(roller_angle.name);
  const std::vector<double> signs = detail::mecanum_signs(wheels);
  if (given.size() > 1 && given.size() != wheels.size())
    throw Error("`roller_angle` has " + std::to_string(given.size()) + " values for " + std::to_string(wheels.size()) +
                " wheels; give one for all, or one a wheel in the order of `wheels` (without it: of the model)");
  if (given.empty() && signs.empty() && !detail::axes_meet(wheels))
    throw Error(quote(robot.name) +
                ": what rollers its wheels have cannot be told: they are neither four about the y axis at the corners "
                "of a rectangle (mecanum wheels) nor do their axes meet in their middle (omni wheels): " +
                detail::omni_wheels_found(finder) + ". Give `roller_angle`");
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    OmniWheel& w = wheels[i];
    if (p.real(wheel_radius.name) > 0) w.radius = p.real(wheel_radius.name);
    w.heading = w.axis.cross(Vec3::UnitZ()).normalized();
    w.roller_angle = given.size() > 1 ? given[i] : given.empty() ? 0 : given[0];
    if (!signs.empty() && given.size() <= 1)
      w.roller_angle = signs[i] * (given.empty() ? std::numbers::pi / 4 : given[0]);
    if (!(std::abs(w.roller_angle) < 1.5))
      throw Error(
          "`roller_angle` is " + number_text(w.roller_angle) +
          " rad; a wheel whose rollers turn about its own axle drives nothing: give an angle between -1.5 and 1.5");
  }
  return wheels;
}

}  // namespace muro::wheels
