// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "muro/algorithm.hpp"
#include "world.hpp"

namespace muro::multibody {

/// All bodies that a world's robots can touch and that the world does not move: scenery, and the bodies of other
/// robots.
class ExternalBodies {
 public:
  /// Collects the external bodies of the scene. Leaves out the items' robots that the world moves (`own`, one per
  /// item), and the originals of those that are shadows. [setup]
  void connect(Connector& c, const std::vector<bool>& own);
  /// Adds the bodies to the world with their present states. Throws Error with the name of a body that the engine
  /// cannot take. [setup]
  void add_to(World& world);
  /// Copies properties into states. Throws Error with the name of a body whose pose or twist is invalid.
  void import();

 private:
  /// A body of another robot.
  struct RobotBody {
    ExternalBody body;
    ExternalBodyState state;
    In<Pose> pose;
    In<Twist> twist;
    In<std::uint64_t> contact_world;
  };

  static ExternalBody body_of(const Connector& c, ObjectId object);

  std::deque<ExternalBody> scenery_;
  std::deque<RobotBody> robot_bodies_;
};

}  // namespace muro::multibody
