// SPDX-License-Identifier: MIT
// `on_contact: stop` for a robot whose links move against each other.
#pragma once

#include <algorithm>
#include <vector>

#include "muro/toolkit/contact_stop.hpp"
#include "muro/toolkit/link_pose.hpp"

namespace muro::biped {

/// Variant of ContactStop that uses the velocity of the link that touches.
class LinkStop {
 public:
  LinkStop() = default;
  /// Connects the links after the joints of the robot have got their properties. `ground`: the shape on which it walks.
  /// [setup]
  LinkStop(Connector& c, const RobotView& robot, const ShapeOfObject& ground) : robot_(&robot), ground_(ground) {
    if (c.parameters().text(on_contact.name) != "stop") return;
    contacts_ = c.read_list(robot.base(), keys::contacts);
    for (const Link& link : robot.links) {
      joints_.emplace_back();
      if (link.joint == JointKind::fixed) continue;
      joints_.back() = {c.write(link.joint_object, keys::joint_position),
                        c.write(link.joint_object, keys::joint_velocity), 0};
    }
  }

  /// Whether it may stop the robot at all.
  explicit operator bool() const { return bool(contacts_); }

  /// Keeps the positions of the joints. [step]
  void begin_step() {
    for (Joint& j : joints_)
      if (j.position) j.before = *j.position;
  }
  /// Whether a link would move on against a body that it touches. The base is at `base` with `twist`, and the joints
  /// have their present state. [step]
  bool blocks(const Pose& base, const Twist& twist) const {
    for (const Contact& c : *contacts_) {
      if (c.other == ground_.object && c.other_shape == ground_.shape) continue;
      const auto touches = [&c](const Link& link) { return link.object == c.self; };
      const auto link = std::find_if(robot_->links.begin(), robot_->links.end(), touches);
      if (link == robot_->links.end()) continue;
      Vec3 velocity = twist.at(c.point - base.position);
      add_velocity(std::size_t(link - robot_->links.begin()), base, c.point, velocity);
      if (velocity.dot(c.normal) < -steepest * velocity.norm()) return true;
    }
    return false;
  }
  /// Puts the joints back where they were, at rest. [step]
  void take_back() const {
    for (const Joint& j : joints_)
      if (j.position) *j.position = j.before, *j.velocity = 0;
  }

 private:
  static constexpr double steepest = 0.02;  ///< sine of the angle between velocity and surface
  struct Joint {
    Out<double> position, velocity;
    double before = 0;
  };

  /// Adds the velocity that the joints on the way to link `i` give to its point (m, world). Returns the pose of the
  /// link.
  Pose add_velocity(std::size_t i, const Pose& base, const Vec3& point, Vec3& velocity) const {
    if (i == 0) return base;
    const Link& link = robot_->links[i];
    const Joint& joint = joints_[i];
    const Pose pose = add_velocity(std::size_t(link.parent), base, point, velocity) *
                      pose_in_parent(link, joint.position ? *joint.position : 0);
    if (link.joint == JointKind::fixed) return pose;
    const Vec3 speed = pose.orientation * Vec3(link.axis * *joint.velocity);
    velocity += link.joint == JointKind::revolute ? Vec3(speed.cross(point - pose.position)) : speed;
    return pose;
  }

  const RobotView* robot_ = nullptr;
  ShapeOfObject ground_;
  ListIn<Contact> contacts_;
  std::vector<Joint> joints_;  ///< one per link
};

}  // namespace muro::biped
