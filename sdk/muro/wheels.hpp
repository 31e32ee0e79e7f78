// SPDX-License-Identifier: MIT
// The driven wheels of a robot, for motion models and drives of wheeled vehicles.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// A wheel that rolls on the plane below the base, about an axis along the base's y axis.
struct Wheel {
  std::uint32_t frame = 0;     ///< of the robot
  Vec3 centre = Vec3::Zero();  ///< m, in the base's frame, joints at 0
  double radius = 0;           ///< m
  double direction = 1;        ///< 1: a positive joint velocity rolls forward (axis along +y); -1: backward
  JointLimits limits;
};

struct Wheels {
  std::vector<Wheel> left, right;
  double track = 0;            ///< m, between the middle of the left and the middle of the right wheels
  Vec3 middle = Vec3::Zero();  ///< m, in the base's frame: half way between these two
};

/// What the user may say instead of the model.
struct WheelChoice {
  std::span<const std::string_view> left, right;  ///< names of joints; empty: as the model has them
  double radius = 0;                              ///< m; 0: of each wheel's shape
  double track = 0;                               ///< m; 0: between the wheels' centres
};

namespace detail {

class WheelFinder {
 public:
  WheelFinder(const Connector& connector, const RobotView& robot) : connector_(connector), robot_(robot) {
    const std::size_t n = robot.frames.size();
    in_base_.resize(n);
    carrier_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Frame& f = robot.frames[i];
      const bool carried = i > 0 && f.joint == JointKind::fixed;
      if (i > 0) in_base_[i] = in_base_[std::size_t(f.parent)] * f.origin;
      carrier_[i] = carried ? carrier_[std::size_t(f.parent)] : i;
    }
  }

  /// Whether joint and shape of frame `i` make it a driven wheel; otherwise `why` says what speaks against it.
  bool is_wheel(std::size_t i, Wheel& wheel, std::string& why) const {
    const Frame& f = robot_.frames[i];
    if (!turns_freely(i, why)) return false;
    if (std::abs(axis(i).y()) < parallel)
      return reject(why, "turns about " + text(axis(i)) + ", not the y axis, of the base");
    for (std::size_t p = std::size_t(f.parent); p > 0; p = std::size_t(robot_.frames[p].parent))
      if (robot_.frames[p].joint == JointKind::revolute && std::abs(axis(p).y()) < parallel)
        return reject(why, "is steered by " + name(p));
    wheel = {std::uint32_t(i), in_base_[i].position, 0, axis(i).y() > 0 ? 1.0 : -1.0, f.limits};
    if (!take_shape(wheel)) return reject(why, "has no cylinder or sphere about its axis as a shape");
    if (std::abs(wheel.centre.y()) < 0.01 * wheel.radius)
      return reject(why, "lies in the middle, neither left nor right");
    return true;
  }

  /// The wheel at the joint that the user names.
  Wheel named(std::string_view joint, bool needs_shape) const {
    for (std::size_t i = 0; i < robot_.frames.size(); ++i) {
      if (robot_.frames[i].joint == JointKind::fixed || name(i) != quoted(joint)) continue;
      std::string why;
      if (!turns_freely(i, why)) throw Error("joint " + name(i) + " cannot drive a wheel: it " + why);
      if (std::abs(axis(i).y()) < 0.5)
        throw Error("joint " + name(i) + " cannot drive a wheel: it turns about " + text(axis(i)) +
                    ", not the y axis, of the base");
      Wheel wheel{std::uint32_t(i), in_base_[i].position, 0, axis(i).y() > 0 ? 1.0 : -1.0, robot_.frames[i].limits};
      if (!take_shape(wheel) && needs_shape)
        throw Error("the wheel of joint " + name(i) + " has no cylinder or sphere about its axis; give `wheel_radius`");
      return wheel;
    }
    throw Error("`" + std::string(robot_.name) + "` has no joint " + quoted(joint) + "; its joints are:" + joints());
  }

  /// Every joint that turns, each with what keeps it from being a driven wheel; those with limits are only counted.
  std::string what_was_found() const {
    std::string all;
    int limited = 0;
    const auto add = [&](const std::string& more) { all += (all.empty() ? "" : "; ") + more; };
    for (std::size_t i = 1; i < robot_.frames.size(); ++i) {
      if (robot_.frames[i].joint != JointKind::revolute) continue;
      Wheel wheel;
      std::string why;
      const bool fine = is_wheel(i, wheel, why);
      if (!fine && has_limits(i))
        ++limited;
      else
        add(name(i) + " " + (!fine ? why : wheel.centre.y() > 0 ? "is on the left" : "is on the right"));
    }
    if (limited > 0)
      add(std::to_string(limited) + (limited == 1 ? " joint has" : " joints have") + " limits of position");
    return all.empty() ? "no joint of it turns" : all;
  }

 private:
  static constexpr double parallel = 0.995;  ///< cosine of 0.1 rad

  static bool reject(std::string& why, std::string reason) {
    why = std::move(reason);
    return false;
  }
  static std::string quoted(std::string_view s) { return "`" + std::string(s) + "`"; }
  static std::string text(const Vec3& v) {
    const auto number = [](double x) {
      std::string s = std::to_string(std::abs(x) < 5e-4 ? 0.0 : x);
      return s.substr(0, s.size() - 3);
    };
    return "(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
  }
  /// The joint of frame `i` as its model names it.
  std::string name(std::size_t i) const {
    return quoted(connector_.object_name(robot_.frames[i].joint_object).substr(robot_.name.size() + 1));
  }
  std::string joints() const {
    std::string all;
    for (std::size_t i = 0; i < robot_.frames.size(); ++i)
      if (robot_.frames[i].joint != JointKind::fixed) all += " " + name(i);
    return all.empty() ? " none" : all;
  }
  /// The axis of joint `i` in the base's frame, all joints at 0.
  Vec3 axis(std::size_t i) const { return in_base_[i].orientation * robot_.frames[i].axis; }

  bool turns_freely(std::size_t i, std::string& why) const {
    const Frame& f = robot_.frames[i];
    if (f.joint != JointKind::revolute) return reject(why, "does not turn");
    if (f.mimic >= 0) return reject(why, "follows " + name(std::size_t(f.mimic)));
    if (has_limits(i)) return reject(why, "has limits of position");
    return true;
  }
  bool has_limits(std::size_t i) const {
    return std::isfinite(robot_.frames[i].limits.lower) || std::isfinite(robot_.frames[i].limits.upper);
  }

  /// Radius and centre from the largest cylinder or sphere about the axis, among the collision shapes of the bodies
  /// that the joint carries rigidly, else among their visual shapes.
  bool take_shape(Wheel& wheel) const {
    for (const Key<Shape>& key : {keys::collision_shapes, keys::visual_shapes}) {
      for (std::size_t k = wheel.frame; k < carrier_.size(); ++k) {
        if (carrier_[k] != wheel.frame) continue;
        for (const Shape& s : connector_.constant_array(robot_.frames[k].object, key))
          take_shape(wheel, in_base_[k], s);
      }
      if (wheel.radius > 0) return true;
    }
    return false;
  }
  void take_shape(Wheel& wheel, const Pose& body, const Shape& s) const {
    const Pose pose = body * s.origin;
    const Vec3 along = axis(wheel.frame), offset = pose.position - in_base_[wheel.frame].position;
    const bool round =
        s.kind == ShapeKind::sphere ||
        (s.kind == ShapeKind::cylinder && std::abs((pose.orientation * Vec3::UnitZ()).dot(along)) >= parallel);
    const bool centred = (offset - along * along.dot(offset)).norm() <= 0.1 * s.size.x();
    if (!round || !centred || s.size.x() <= wheel.radius) return;
    wheel.radius = s.size.x();
    wheel.centre = pose.position;
  }

  const Connector& connector_;
  const RobotView& robot_;
  std::vector<Pose> in_base_;         ///< joints at 0
  std::vector<std::size_t> carrier_;  ///< the frame whose joint moves this one
};

inline Vec3 mean_centre(const std::vector<Wheel>& wheels) {
  Vec3 sum = Vec3::Zero();
  for (const Wheel& w : wheels) sum += w.centre;
  return sum / double(wheels.size());
}

}  // namespace detail

/// The driven wheels of `robot`, joints at 0.
///
/// Unless they are named, these are the joints without limits of position whose axis is parallel to the base's y axis
/// (to 0.1 rad) and that carry a cylinder or sphere about this axis; left is y > 0. Casters and steered wheels (a joint
/// about another axis lies between them and the base) and joints that follow others are no driven wheels.
/// Throws Error with what the model has when a side has no wheel or a wheel no radius. [setup]
inline Wheels find_wheels(const Connector& connector, const RobotView& robot, const WheelChoice& choice = {}) {
  const detail::WheelFinder finder(connector, robot);
  Wheels wheels;
  if (choice.left.empty() != choice.right.empty())
    throw Error(std::string("`") + (choice.left.empty() ? "right" : "left") + "` names wheels, but `" +
                (choice.left.empty() ? "left" : "right") + "` does not; name the wheels of both sides or of none");
  if (!choice.left.empty()) {
    for (const std::string_view joint : choice.left) wheels.left.push_back(finder.named(joint, choice.radius <= 0));
    for (const std::string_view joint : choice.right) wheels.right.push_back(finder.named(joint, choice.radius <= 0));
  } else {
    for (std::size_t i = 1; i < robot.frames.size(); ++i) {
      Wheel wheel;
      std::string why;
      if (robot.frames[i].joint == JointKind::revolute && finder.is_wheel(i, wheel, why))
        (wheel.centre.y() > 0 ? wheels.left : wheels.right).push_back(wheel);
    }
  }
  if (wheels.left.empty() || wheels.right.empty())
    throw Error("`" + std::string(robot.name) + "` has no driven wheels on " +
                (!wheels.left.empty()    ? "the right (y < 0)"
                 : !wheels.right.empty() ? "the left (y > 0)"
                                         : "either side") +
                ": " + finder.what_was_found() + ". Name the wheels' joints with `left` and `right`");
  if (choice.radius > 0)
    for (auto* side : {&wheels.left, &wheels.right})
      for (Wheel& w : *side) w.radius = choice.radius;
  for (const Wheel& l : wheels.left)
    for (const Wheel& r : wheels.right)
      if (l.frame == r.frame) throw Error("`left` and `right` name the same wheel; each wheel is on one side");
  const Vec3 left = detail::mean_centre(wheels.left), right = detail::mean_centre(wheels.right);
  wheels.middle = 0.5 * (left + right);
  wheels.track = choice.track > 0 ? choice.track : left.y() - right.y();
  if (!(wheels.track > 0))
    throw Error("the wheels of `left` lie on the right of those of `right` (their y axis points left): " +
                finder.what_was_found());
  return wheels;
}

}  // namespace muro
