// SPDX-License-Identifier: MIT
// Wheels of a vehicle that turns by steering some of them.
#pragma once

#include <algorithm>

#include "plugins/common/text/quote.hpp"
#include "wheel_finder.hpp"

namespace muro::wheels {

struct SteeredWheel : Wheel {
  std::int32_t steering = -1;     ///< link whose joint steers it; -1: none
  Vec3 pivot = Vec3::Zero();      ///< m, in the base's frame: a point on its steering axis
  double steering_direction = 1;  ///< 1: a positive angle turns it to the left (axis along +z); -1: to the right
  bool driven = false;            ///< a drive turns it; else the ground does
};

namespace detail {

class SteeredWheelFinder {
 public:
  SteeredWheelFinder(const Connector& connector, const RobotView& robot)
      : finder_(connector, robot), parameters_(connector.parameters()), steers_(robot.links.size(), false) {
    const std::span<const std::string_view> named = parameters_.texts(steering_joints.name);
    for (const std::string_view joint : named) {
      const std::size_t i = finder_.joint(joint);
      if (finder_.link(i).joint != JointKind::revolute || std::abs(finder_.axis(i).z()) < 0.5)
        throw Error("joint " + finder_.name(i) + " cannot steer: it " +
                    (finder_.link(i).joint == JointKind::revolute
                         ? "turns about " + WheelFinder::to_text(finder_.axis(i)) + ", not the z axis, of the base"
                         : "does not turn"));
      steers_[i] = true;
    }
    for (std::size_t i = 1; i < steers_.size() && named.empty(); ++i)
      steers_[i] = is_upright(i) && (finder_.has_limits(i) || finder_.link(i).mimic >= 0);
  }

  std::vector<SteeredWheel> all() const {
    std::vector<SteeredWheel> wheels;
    const std::span<const std::string_view> driven = parameters_.texts(driven_wheels.name);
    const std::span<const std::string_view> rolling = parameters_.texts(rolling_wheels.name);
    add_named(wheels, driven, true);
    add_named(wheels, rolling, false);
    if (driven.empty() || rolling.empty()) {
      for (std::size_t i = 1; i < steers_.size(); ++i) {
        SteeredWheel wheel;
        std::string why;
        if (is_named(wheels, i) || !is_wheel(i, wheel, why)) continue;
        wheel.driven = driven.empty() && wheel.steering < 0;
        wheels.push_back(wheel);
      }
      if (std::none_of(wheels.begin(), wheels.end(), [](const SteeredWheel& w) { return w.driven; }))
        for (SteeredWheel& w : wheels)  // all wheels that may be driven are steered
          w.driven = !std::any_of(rolling.begin(), rolling.end(),
                                  [&](std::string_view joint) { return finder_.name(w.link) == quote(joint); });
    }
    std::sort(wheels.begin(), wheels.end(), [](const auto& a, const auto& b) { return a.link < b.link; });
    if (const double radius = parameters_.real(wheel_radius.name); radius > 0)
      for (SteeredWheel& w : wheels) w.radius = radius;
    return wheels;
  }

  std::string what_was_found() const {
    return finder_.what_was_found([&](std::size_t i, std::string& what) {
      if (steers_[i]) return what = "steers", true;
      SteeredWheel wheel;
      if (!is_wheel(i, wheel, what)) return false;
      what = wheel.steering < 0 ? "is a wheel that is not steered" : "is a wheel that is steered";
      return true;
    });
  }

 private:
  bool is_upright(std::size_t i) const {
    return finder_.link(i).joint == JointKind::revolute && std::abs(finder_.axis(i).z()) >= WheelFinder::cos_tolerance;
  }

  /// Whether joint and shape of link `i` make it a wheel; otherwise `why` gives the reason.
  bool is_wheel(std::size_t i, SteeredWheel& wheel, std::string& why) const {
    if (!finder_.turns_freely(i, why)) return false;
    if (std::abs(finder_.axis(i).y()) < WheelFinder::cos_tolerance)
      return WheelFinder::reject(
          why, "turns about " + WheelFinder::to_text(finder_.axis(i)) + ", not the y axis, of the base");
    static_cast<Wheel&>(wheel) = finder_.wheel(i);
    if (!(wheel.radius > 0)) return WheelFinder::reject(why, "has no cylinder or sphere about its axis as a shape");
    return find_steering(wheel, why);
  }

  /// Finds the joint between the wheel and the base that steers it. Joints about horizontal axes are suspensions.
  bool find_steering(SteeredWheel& wheel, std::string& why) const {
    for (std::size_t p = finder_.parent(wheel.link); p > 0; p = finder_.parent(p)) {
      if (finder_.link(p).joint != JointKind::revolute) continue;
      if (steers_[p]) {
        if (wheel.steering >= 0)
          return WheelFinder::reject(why, "is steered by two joints, " + finder_.name(std::size_t(wheel.steering)) +
                                              " and " + finder_.name(p));
        wheel.steering = std::int32_t(p);
        wheel.pivot = finder_.origin(p);
        wheel.steering_direction = finder_.axis(p).z() > 0 ? 1 : -1;
      } else if (std::abs(finder_.axis(p).z()) > WheelFinder::sin_tolerance) {
        return WheelFinder::reject(why, "swivels about " + finder_.name(p) + " as casters do");
      }
    }
    return true;
  }

  void add_named(std::vector<SteeredWheel>& wheels, std::span<const std::string_view> joints, bool driven) const {
    const auto fits = [](const Vec3& axis) { return std::abs(axis.z()) <= WheelFinder::sin_tolerance; };
    for (const std::string_view joint : joints) {
      SteeredWheel wheel;
      std::string why;
      static_cast<Wheel&>(wheel) = finder_.named(joint, parameters_.real(wheel_radius.name), fits, "a horizontal axis");
      if (!find_steering(wheel, why))
        throw Error("the wheel of joint " + finder_.name(wheel.link) + " " + why +
                    "; name the joint that steers it, one alone, with `steering`");
      if (is_named(wheels, wheel.link))
        throw Error("joint " + finder_.name(wheel.link) +
                    " is named twice; name a wheel once, in `driven` or in `rolling`");
      wheel.driven = driven;
      wheels.push_back(wheel);
    }
  }
  static bool is_named(const std::vector<SteeredWheel>& wheels, std::size_t link) {
    return std::any_of(wheels.begin(), wheels.end(), [&](const SteeredWheel& w) { return w.link == link; });
  }

  WheelFinder finder_;
  const Parameters& parameters_;
  std::vector<bool> steers_;  ///< whether the joint of each link steers
};

}  // namespace detail

/// Returns the wheels of `robot`, joints at 0, in the order of its links: at least two, of which at least one is
/// steered and at least one is driven. Uses the parameters `steering`, `driven`, `rolling` and `wheel_radius`.
///
/// Wheels that are not named are joints without limits of position whose axis is parallel to the base's y axis (to 0.1
/// rad) and that carry a cylinder or sphere about this axis. A joint parallel to the base's z axis between a wheel and
/// the base steers the wheel if it has limits of position or follows another joint. Otherwise it is the swivel of a
/// caster, whose wheel does not count. Wheels that are not steered are driven; if all are steered, all are driven.
/// Throws Error with a list of the model's joints. [setup]
inline std::vector<SteeredWheel> find_steered_wheels(const Connector& connector, const RobotView& robot) {
  const detail::SteeredWheelFinder finder(connector, robot);
  std::vector<SteeredWheel> wheels = finder.all();
  const auto reject = [&](const std::string& what, const std::string& advice) {
    throw Error(quote(robot.name) + " has " + what + ": " + finder.what_was_found() + ". " + advice);
  };
  if (std::none_of(wheels.begin(), wheels.end(), [](const SteeredWheel& w) { return w.steering >= 0; }))
    reject("no steered wheels",
           "Name the joints that steer with `steering`; a vehicle that turns by the speeds of its wheels is one for "
           "motion.differential_drive or motion.omni and their drives");
  if (std::none_of(wheels.begin(), wheels.end(), [](const SteeredWheel& w) { return w.driven; }))
    reject("no driven wheels", "Name the joints of driven wheels with `driven`");
  if (wheels.size() < 2)
    reject("one wheel alone", "At least two are needed; name their joints with `driven` and `rolling`");
  return wheels;
}

}  // namespace muro::wheels
