// SPDX-License-Identifier: MIT
// The interface of a multi-body engine to a scene: between the motions by engines and their common part.
#pragma once

#include <memory>

#include "forward_kinematics.hpp"
#include "muro/algorithm.hpp"

namespace muro::multibody {

/// A failure of an engine that names the robot.
class RobotFailure : public Error {
 public:
  RobotFailure(const std::string& text, const RobotState& robot) : Error(text), robot_(&robot) {}
  const RobotState* robot() const { return robot_; }

 private:
  const RobotState* robot_;
};

/// A body that the world does not move: scenery, or a body of a robot that another motion moves.
struct ExternalBody {
  std::string name;  ///< the body and its name keep their addresses
  std::vector<BodyShape> shapes;
  Pose pose;  ///< pose of scenery
};

/// State of an external body that may move; input.
struct ExternalBodyState {
  MotionType motion_type = MotionType::kinematic;  ///< or disabled
  Pose pose;
  Twist twist;
};

/// One world of an engine. It is built anew whenever a run starts or continues from a snapshot. So its results depend
/// only on the given states, including RobotState::memory.
class World {
 public:
  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  virtual ~World() = default;

  /// Adds scenery.
  virtual void add_static_body(const ExternalBody& body) = 0;
  /// Adds an external body that may move. `state` keeps its address and is read in each step.
  virtual void add_kinematic_body(const ExternalBody& body, const ExternalBodyState& state) = 0;
  /// Adds a robot. `model` and `state` keep their addresses; the state is read and written in each step.
  virtual void add_robot(const RobotModel& model, RobotState& state) = 0;
  /// Completes the world when everything has been added and states hold the start.
  virtual void complete() = 0;
  /// Moves all dynamic robots by `dt` (s). Throws Error with the engine's message when it fails; the world is not used
  /// again after that.
  virtual void advance(double dt) = 0;
};

}  // namespace muro::multibody
