// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "muro/connector.hpp"
#include "muro/vocabulary.hpp"

namespace muro::view {

/// Poses of the links of all robots, and of the laser scanners and cameras on them.
class BodyPoses {
 public:
  struct Body {
    In<Pose> pose;
    ObjectId object = no_object;
    RobotId robot = no_robot;
    bool is_base = false;
  };

  /// [setup]
  void connect_links(Connector& c) {
    for (const RobotView* robot : c.robots())
      for (const Link& link : robot->links) add(c, link.object, robot->id, link.object == robot->base());
    link_count_ = bodies_.size();
  }
  /// Called after connect_links, when all sensors have connected. [setup]
  void connect_sensors(Connector& c) {
    for (std::uint32_t i = 0; i < c.object_count(); ++i)
      if (const RobotId robot = c.robot_of(ObjectId(i)); robot != no_robot)
        for (const FoundProperty& found : c.properties(ObjectId(i)))
          if (found.key->name == keys::ranges.name || found.key->name == keys::camera_width.name)
            add(c, ObjectId(i), robot, false);
  }

  std::span<const Body> all() const { return bodies_; }
  std::span<const Body> links() const { return {bodies_.data(), link_count_}; }
  /// Returns the pose of an object, or null when it is not among them.
  const Pose* find(ObjectId object) const {
    for (const Body& b : bodies_)
      if (b.object == object) return b.pose.get();
    return nullptr;
  }

 private:
  void add(Connector& c, ObjectId object, RobotId robot, bool is_base) {
    bodies_.push_back({c.read(object, keys::pose), object, robot, is_base});
  }

  std::vector<Body> bodies_;  ///< links first
  std::size_t link_count_ = 0;
};

}  // namespace muro::view
