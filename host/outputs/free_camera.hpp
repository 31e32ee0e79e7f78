// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/shape_files.hpp"
#include "host/scenario/terrain.hpp"

namespace muro::host {

/// A camera that belongs to no robot. Where its position or what it looks at is not given, it follows the robots that
/// move: those whose base is not where it was at the start, or all that can move while none has. A position of its own
/// choice is above the ground, and so high that no hill is between it and them.
class FreeCamera {
 public:
  /// Adds the object `name`, whose pose it sets. Given points: m. Before the simulation is built.
  FreeCamera(Simulation& simulation, const char* name, const std::optional<Vec3>& from, const std::optional<Vec3>& to);

  ObjectId object() const { return object_; }
  /// m, from the camera to the point that it looks at.
  double distance() const { return (from() - target_).norm(); }

  /// Sets its pose for the present state. `dt`: s since the last time, by which it is slow to follow; infinite: at
  /// once.
  void look(double dt);

 private:
  struct Member {
    ObjectId base;
    Vec3 start;
    double radius;  ///< m, of a ball about the base that holds the robot
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
  std::shared_ptr<Hills> hills_;  ///< null: there are none, or the position is given
  std::vector<Member> team_;
  ObjectId object_ = no_object;
  Pose* pose_ = nullptr;
  Vec3 target_ = Vec3::Zero();  ///< the middle of the robots
  double radius_ = 0;           ///< m, about the middle
};

}  // namespace muro::host
