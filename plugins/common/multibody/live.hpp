// SPDX-License-Identifier: MIT
// What passes between the properties of a scene and an engine's world in each step.
#pragma once

#include "model.hpp"
#include "muro/geometry.hpp"

namespace muro::multibody {

/// What a world makes of a robot at present.
enum class Presence : std::uint8_t {
  simulated,  ///< its bodies are the world's to move
  obstacle,   ///< no force moves it: it pushes and is not pushed
  absent,     ///< forces move it elsewhere; contact with it is not the world's business
};

/// What the drive of a joint is to do in a step.
struct Demand {
  bool by_speed = false;  ///< keep to `speed` with an effort of at most `most`; else `effort` acts
  double speed = 0;       ///< rad/s or m/s
  double most = 0;        ///< N m or N; may be infinite
  double effort = 0;      ///< N m or N
};

/// State of a part's joint; unused for the base.
struct JointState {
  double position = 0;  ///< rad or m, along the axis
  double velocity = 0;
  double effort = 0;  ///< out: what the drive applied in the last step
  Demand demand;
};

/// State of a robot, in and out.
struct RobotState {
  Presence presence = Presence::simulated;
  Pose pose;                       ///< of the base
  Twist twist;                     ///< of the base, at its origin
  std::vector<JointState> joints;  ///< one a part
  std::vector<Wrench> external;    ///< in: one a part, at the part's origin, world axes
  std::vector<Wrench> contact;  ///< out: one a body of the model, at its part's origin: what the world's contacts did
  bool moved_from_outside = false;  ///< in: it is not where the last step left it
  bool applied = false;             ///< in: some `external` is not zero
  std::span<double> memory;         ///< in and out: what the engine keeps of it, part of the state
};

/// Poses (world) and twists (at the parts' origins, world axes) of all parts.
struct PartMotion {
  Pose pose;
  Twist twist;
};
/// From base and joints. `out`: one a part.
void place_parts(const RobotModel& model, const RobotState& state, std::span<PartMotion> out);

}  // namespace muro::multibody
