// SPDX-License-Identifier: MIT
// Motion of any frame of a robot, from its base and the joints on the way there.
#pragma once

#include <vector>

#include "frame_motion.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro::link_motion {

/// Values that are needed; each includes those before it.
enum class Order : std::uint8_t { pose, twist, acceleration };

/// Position, velocity and acceleration of a joint. If nothing moves a mimic joint but the joint that it follows, they
/// are those of its leader.
class JointMotion {
 public:
  JointMotion() = default;
  /// Binds what `order` needs of the joint that leads to `link`. `start` (rad or m): used if nothing moves it. [setup]
  JointMotion(Connector& c, const RobotView& robot, std::uint32_t link, double start, Order order);

  double position() const { return offset_ + multiplier_ * *position_; }
  double velocity() const { return multiplier_ * *velocity_; }
  double acceleration() const { return multiplier_ * *acceleration_; }
  /// Must be called after all have connected: throws Error if it is moved, but no motion gives its acceleration.
  /// [setup]
  void check_acceleration(const Connector& c) const;

 private:
  static constexpr double none = 0;
  In<double> position_, velocity_{&none}, acceleration_{&none};
  double multiplier_ = 1, offset_ = 0;
  ObjectId object_ = no_object;
};

class LinkMotion {
 public:
  LinkMotion() = default;
  /// Binds what `order` needs for the frame at `origin` in that of link `link`. [setup]
  LinkMotion(Connector& c, const RobotView& robot, std::uint32_t link, const Pose& origin, Order order);

  /// Whether it has a frame.
  explicit operator bool() const { return bool(base_pose_); }

  /// Must be called after all have connected: throws Error if no motion of the robot gives a wanted acceleration.
  /// [setup]
  void check(const Connector& c) const;

  /// Returns the present motion. Values that `order` does not include are zero. [step]
  FrameMotion now() const {
    static const Twist none;
    FrameMotion m{*base_pose_, twist_ ? *twist_ : none, acceleration_ ? *acceleration_ : none};
    for (const Joint& j : joints_)
      m = m.at(j.origin).behind(j.kind, j.axis, j.motion.position(), j.motion.velocity(), j.motion.acceleration());
    return is_at_origin_ ? m : m.at(origin_);
  }

 private:
  struct Joint {
    Pose origin;  ///< with the joint at 0, in the frame behind the joint before
    JointKind kind = JointKind::fixed;
    Vec3 axis = Vec3::UnitX();
    JointMotion motion;
  };
  const RobotView* robot_ = nullptr;
  In<Pose> base_pose_;
  In<Twist> twist_, acceleration_;
  std::vector<Joint> joints_;
  Pose origin_;  ///< of the frame, in the one behind the last joint
  bool is_at_origin_ = false;
};

}  // namespace muro::link_motion
