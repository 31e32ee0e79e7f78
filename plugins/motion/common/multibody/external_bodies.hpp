// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "muro/algorithm.hpp"
#include "world.hpp"

namespace muro::multibody {

/// All that a world's robots can touch and that the world does not move: scenery, and the bodies of other robots.
class ExternalBodies {
 public:
  /// Of the scene, but not of those of the items' robots that are the world's `own`, nor of the originals of which they
  /// are shadows. `own`: one an item. [setup]
  void connect(Connector& c, const std::vector<bool>& own);
  /// Adds them, with their present states. Throws Error with the name of one that the engine cannot take. [setup]
  void add_to(World& world);
  /// Properties to states. Throws Error with the name of a body that is nowhere.
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
