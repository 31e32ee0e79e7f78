// SPDX-License-Identifier: MIT
// What a multi-body engine is for a scene: the interface between the motions by engines and what they share.
#pragma once

#include <memory>

#include "forward_kinematics.hpp"
#include "muro/algorithm.hpp"

namespace muro::multibody {

/// A failure of an engine that tells the robot.
class RobotFailure : public Error {
 public:
  RobotFailure(const std::string& text, const RobotState& robot) : Error(text), robot_(&robot) {}
  const RobotState* robot() const { return robot_; }

 private:
  const RobotState* robot_;
};

/// A body that the world does not move: scenery, or a body of a robot that another motion moves.
struct ExternalBody {
  std::string name;  ///< the body and its name stay where they are
  std::vector<BodyShape> shapes;
  Pose pose;  ///< of scenery
};

/// State of an external body that may move, in.
struct ExternalBodyState {
  MotionType motion_type = MotionType::kinematic;  ///< or disabled
  Pose pose;
  Twist twist;
};

/// One world of an engine. Built anew whenever a run starts or goes on from a snapshot: what it does follows from the
/// states that it is given alone, from RobotState::memory too.
class World {
 public:
  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  virtual ~World() = default;

  /// Scenery.
  virtual void add_static_body(const ExternalBody& body) = 0;
  /// `state` stays where it is and is read in each step.
  virtual void add_kinematic_body(const ExternalBody& body, const ExternalBodyState& state) = 0;
  /// `model` and `state` stay where they are; the state is read and written in each step.
  virtual void add_robot(const RobotModel& model, RobotState& state) = 0;
  /// Everything has been added; states hold the start.
  virtual void complete() = 0;
  /// Carries all dynamic robots on by `dt` (s). Throws Error with the engine's words when it fails; it is not used
  /// again then.
  virtual void advance(double dt) = 0;
};

}  // namespace muro::multibody
