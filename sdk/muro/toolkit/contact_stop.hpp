// SPDX-License-Identifier: MIT
// The behaviour of motions without forces when their robot touches something.
#pragma once

#include <algorithm>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

inline constexpr std::string_view on_contact_modes[] = {"ignore", "stop"};
/// The parameter, and the property that is read when it is `stop`.
inline constexpr Parameter on_contact =
    text("on_contact", "ignore", "stop: the robot does not move on against what it touches").one_of(on_contact_modes);
inline constexpr PropertyUse on_contact_reads{"contacts", "of the robot", "on_contact=stop"};

/// One of the collision shapes of an object.
struct ShapeOfObject {
  ObjectId object = no_object;
  std::uint32_t shape = 0;  ///< index among its shapes
};

/// Decides whether a robot may move on. One for each robot, created while connecting.
class ContactStop {
 public:
  ContactStop() = default;
  /// `ground`: scenery on which the robot moves whatever its slope; must outlive this. [setup]
  ContactStop(Connector& c, const RobotView& robot, std::span<const ShapeOfObject> ground = {}) : ground_(ground) {
    if (c.parameters().text(on_contact.name) == "stop") contacts_ = c.read_list(robot.base(), keys::contacts);
  }

  /// Whether the robot touches something against which it would move with `twist` (world axes, at `origin`). A contact
  /// that slides along a surface, such as that of a wheel on the ground, does not block it. [step]
  bool blocks(const Vec3& origin, const Twist& twist) const {
    if (!contacts_) return false;
    for (const Contact& c : *contacts_) {
      const auto is_touched = [&c](const ShapeOfObject& s) { return s.object == c.other && s.shape == c.other_shape; };
      if (std::any_of(ground_.begin(), ground_.end(), is_touched)) continue;
      const Vec3 velocity = twist.at(c.point - origin);
      if (velocity.dot(c.normal) < -steepest * velocity.norm()) return true;
    }
    return false;
  }

 private:
  static constexpr double steepest = 0.02;  ///< sine of the allowed angle between velocity and surface
  ListIn<Contact> contacts_;
  std::span<const ShapeOfObject> ground_;
};

}  // namespace muro
