// SPDX-License-Identifier: MIT
// The frame of any object in the scene, named by a sensor.
#pragma once

#include <string>
#include <utility>

#include "plugins/common/link_motion/link_motion.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::internal_sensor {

/// Motion of the frame of a part of a robot, or of scenery, which does not move. Without an object: of the world.
class SceneFrame {
 public:
  SceneFrame() = default;
  SceneFrame(link_motion::LinkMotion link)  // NOLINT(google-explicit-constructor): it is one
      : link_(std::move(link)) {}
  /// Returns the frame of the object `name`: a part of the robot of `item`, a robot (its base), `robot/part`, or
  /// scenery. Throws Error if there is no object of this name with a pose. [setup]
  static SceneFrame named(Connector& c, const Item& item, std::string_view name) {
    using link_motion::LinkMotion, link_motion::Order;
    for (const RobotView* robot : c.robots())
      if (robot->name == name) return LinkMotion(c, *robot, 0, Pose{}, Order::twist);
    ObjectId object = c.find_object(std::string(item.robot->name) + "/" + std::string(name));
    if (object == no_object) object = c.find_object(name);
    const RobotId id = object == no_object ? no_robot : c.robot_of(object);
    if (id != no_robot) {
      const RobotView& robot = *c.robots()[index_of(id)];
      for (std::uint32_t i = 0; i < robot.links.size(); ++i)
        if (robot.links[i].object == object) return LinkMotion(c, robot, i, Pose{}, Order::twist);
    }
    const auto standing = object == no_object ? std::nullopt : c.constant(object, keys::pose);
    if (!standing)
      throw Error("nothing in the scene is named " + quote(name) +
                  " and has a pose; name a part of the own robot, a robot, `robot/part`, or scenery "
                  "(`muro describe` lists them)");
    SceneFrame frame;
    frame.standing_ = *standing;
    return frame;
  }

  /// [step]
  link_motion::FrameMotion now() const { return link_ ? link_.now() : link_motion::FrameMotion{standing_, {}, {}}; }

 private:
  link_motion::LinkMotion link_;
  Pose standing_;  ///< pose of an object that does not move
};

}  // namespace muro::internal_sensor
