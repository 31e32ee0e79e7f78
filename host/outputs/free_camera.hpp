// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/shape_files.hpp"
#include "host/scenario/terrain.hpp"

namespace muro::host {

/// A camera that belongs to no robot. When its position or its target point is not given, it follows the robots that
/// move: those with a base that is not at its start, or all that can move while none has. When it chooses its position,
/// that is above the ground, and so high that no hill is between it and the robots.
class FreeCamera {
 public:
  /// Adds the object `name` and sets its pose. Given points: m. Call before the simulation is built.
  FreeCamera(Simulation& simulation, const char* name, const std::optional<Vec3>& from, const std::optional<Vec3>& to);

  ObjectId object() const { return object_; }
  /// Distance (m) from the camera to its target point.
  double distance() const { return (from() - target_).norm(); }

  /// Sets its pose for the present state. `dt`: s since the last call; the camera follows with a lag. Infinite: it
  /// follows at once.
  void look(double dt);

 private:
  struct Member {
    ObjectId base;
    Vec3 start;
    double radius;  ///< m, radius of a ball about the base that holds the robot
  };

  /// The heightmaps of the scene.
  struct Hills {
    explicit Hills(Simulation& simulation) : files(simulation), ground(files) {}
    ShapeFiles files;
    Terrain ground;
  };

  Vec3 from() const;
  void aim(double part);

  Simulation* simulation_;
  std::optional<Vec3> given_from_, given_to_;
  std::shared_ptr<Hills> hills_;  ///< null: there are no hills, or the position is given
  std::vector<Member> team_;
  ObjectId object_ = no_object;
  Pose* pose_ = nullptr;
  Vec3 target_ = Vec3::Zero();  ///< the middle of the robots
  double radius_ = 0;           ///< m, radius about the middle
};

}  // namespace muro::host
