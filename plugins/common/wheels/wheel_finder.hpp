// SPDX-License-Identifier: MIT
// Search for the wheels of a model: the common part of find_side_wheels, find_steered_wheels and find_omni_wheels.
#pragma once

#include <string>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "parameters.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::wheels {

/// A wheel that rolls on the plane below the base.
struct Wheel {
  std::uint32_t link = 0;      ///< link of the robot to which the wheel's joint leads
  Vec3 centre = Vec3::Zero();  ///< m, in the base's frame, joints at 0
  double radius = 0;           ///< m
  double direction = 1;        ///< 1: a positive joint velocity rolls forward (axis along +y); -1: backward
  JointLimits limits;
  Vec3 axis = Vec3::UnitY();  ///< axis of its joint: unit, in the base's frame, joints at 0
};

/// Inspects the joints and shapes of a robot, all joints at 0. Joint `i` is the one that leads to link `i`.
class WheelFinder {
 public:
  static constexpr double cos_tolerance = 0.995;  ///< directions are parallel up to 0.1 rad
  static constexpr double sin_tolerance = 0.1;

  WheelFinder(const Connector& connector, const RobotView& robot) : connector_(connector), robot_(robot) {
    const std::size_t n = robot.links.size();
    in_base_.resize(n);
    welded_to_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Link& l = robot.links[i];
      const bool welded = i > 0 && l.joint == JointKind::fixed;
      if (i > 0) in_base_[i] = in_base_[std::size_t(l.parent)] * l.origin;
      welded_to_[i] = welded ? welded_to_[std::size_t(l.parent)] : i;
    }
  }

  const Link& link(std::size_t i) const { return robot_.links[i]; }
  /// Axis of joint `i` in the base's frame, and a point on it.
  Vec3 axis(std::size_t i) const { return in_base_[i].orientation * robot_.links[i].axis; }
  const Vec3& origin(std::size_t i) const { return in_base_[i].position; }
  /// Returns the parent of link `i`; 0: the base.
  std::size_t parent(std::size_t i) const { return std::size_t(robot_.links[i].parent); }

  /// Whether joint `i` can turn without end, driven or on its own; otherwise `why` gives the reason.
  bool turns_freely(std::size_t i, std::string& why) const {
    const Link& l = robot_.links[i];
    if (l.joint != JointKind::revolute) return reject(why, "does not turn");
    if (l.mimic >= 0) return reject(why, "follows " + name(std::size_t(l.mimic)));
    if (has_limits(i)) return reject(why, "has limits of position");
    return true;
  }
  bool has_limits(std::size_t i) const {
    return std::isfinite(robot_.links[i].limits.lower) || std::isfinite(robot_.links[i].limits.upper);
  }

  /// Returns the wheel of joint `i`, with the radius and centre of its shape. That is the largest cylinder or sphere
  /// about the axis, among the collision shapes of the links that the joint carries rigidly, or else among their visual
  /// shapes. If there is no such shape, the radius is 0.
  Wheel wheel(std::size_t i) const {
    Wheel found{std::uint32_t(i), origin(i), 0, axis(i).y() > 0 ? 1.0 : -1.0, robot_.links[i].limits, axis(i)};
    for (const Key<Shape>& key : {keys::collision_shapes, keys::visual_shapes}) {
      for (std::size_t k = i; k < welded_to_.size(); ++k) {
        if (welded_to_[k] != i) continue;
        for (const Shape& s : connector_.constant_array(robot_.links[k].object, key))
          consider_shape(found, in_base_[k], s);
      }
      if (found.radius > 0) break;
    }
    return found;
  }

  /// Returns the joint that the user names.
  std::size_t joint(std::string_view wanted) const {
    for (std::size_t i = 0; i < robot_.links.size(); ++i)
      if (robot_.links[i].joint != JointKind::fixed && name(i) == quote(wanted)) return i;
    std::string all;
    for (std::size_t i = 0; i < robot_.links.size(); ++i)
      if (robot_.links[i].joint != JointKind::fixed) all += " " + name(i);
    throw Error(quote(robot_.name) + " has no joint " + quote(wanted) +
                "; its joints are:" + (all.empty() ? " none" : all));
  }

  /// Returns the wheel of the joint that the user names. Its axis must satisfy `fits`; messages describe it as
  /// `wanted`. A `radius` (m) above 0 replaces that of its shape.
  template <class Fits>
  Wheel named(std::string_view wanted_joint, double radius, const Fits& fits, const char* wanted) const {
    const std::size_t i = joint(wanted_joint);
    std::string why;
    if (!turns_freely(i, why)) throw Error("joint " + name(i) + " cannot drive a wheel: it " + why);
    if (!fits(axis(i)))
      throw Error("joint " + name(i) + " cannot drive a wheel: it turns about " + to_text(axis(i)) + ", not " + wanted +
                  ", of the base");
    Wheel found = wheel(i);
    if (radius > 0) found.radius = radius;
    if (!(found.radius > 0))
      throw Error("the wheel of joint " + name(i) + " has no cylinder or sphere about its axis; give `wheel_radius`");
    return found;
  }

  /// Returns a list of every joint that turns, each with the text of `judge(i, what)`, which returns true for a wheel.
  /// Joints with limits that are not wheels are only counted.
  template <class Judge>
  std::string what_was_found(const Judge& judge) const {
    std::string all;
    int limited = 0;
    const auto add = [&](const std::string& more) { all += (all.empty() ? "" : "; ") + more; };
    for (std::size_t i = 1; i < robot_.links.size(); ++i) {
      if (robot_.links[i].joint != JointKind::revolute) continue;
      std::string what;
      if (!judge(i, what) && has_limits(i))
        ++limited;
      else
        add(name(i) + " " + what);
    }
    if (limited > 0)
      add(std::to_string(limited) + (limited == 1 ? " joint has" : " joints have") + " limits of position");
    return all.empty() ? "no joint of it turns" : all;
  }

  static bool reject(std::string& why, std::string reason) {
    why = std::move(reason);
    return false;
  }
  static std::string to_text(const Vec3& v) {
    const auto number = [](double x) {
      std::string s = std::to_string(std::abs(x) < 5e-4 ? 0.0 : x);
      return s.substr(0, s.size() - 3);
    };
    return "(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
  }
  /// Returns the name of joint `i` in its model.
  std::string name(std::size_t i) const {
    return quote(connector_.object_name(robot_.links[i].joint_object).substr(robot_.name.size() + 1));
  }

 private:
  void consider_shape(Wheel& wheel, const Pose& link, const Shape& s) const {
    const Pose pose = link * s.origin;
    const Vec3 offset = pose.position - origin(wheel.link);
    const bool is_round =
        s.kind == ShapeKind::sphere || (s.kind == ShapeKind::cylinder &&
                                        std::abs((pose.orientation * Vec3::UnitZ()).dot(wheel.axis)) >= cos_tolerance);
    const bool is_centred = (offset - wheel.axis * wheel.axis.dot(offset)).norm() <= 0.1 * s.size.x();
    if (!is_round || !is_centred || s.size.x() <= wheel.radius) return;
    wheel.radius = s.size.x();
    wheel.centre = pose.position;
  }

  const Connector& connector_;
  const RobotView& robot_;
  std::vector<Pose> in_base_;           ///< of every link, joints at 0
  std::vector<std::size_t> welded_to_;  ///< the link to which fixed joints attach this one, or itself
};

}  // namespace muro::wheels
