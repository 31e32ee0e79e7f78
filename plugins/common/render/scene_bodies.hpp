// SPDX-License-Identifier: MIT
// Bodies that sensors see: the scenery and the links of all robots except shadows (level.shadow).
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "muro/connector.hpp"
#include "muro/shape.hpp"
#include "muro/vocabulary.hpp"

namespace muro::scene_bodies {

struct SceneBody {
  ObjectId object = no_object;
  RobotId robot = no_robot;  ///< no_robot: scenery
  In<Pose> link_pose{};      ///< of a robot's link; unset for scenery
  Pose scenery_pose{};

  const Pose& pose() const { return link_pose ? *link_pose : scenery_pose; }
};

/// Calls visit(SceneBody, shapes) for each body that has shapes, and binds the poses of these bodies: scenery in the
/// order of objects, then robot by robot. `shapes_of(object)` returns the shapes of a body that count. [setup]
template <class ShapesOf, class Visit>
void for_each_body(Connector& c, ShapesOf shapes_of, Visit visit) {
  const auto visit_body = [&](SceneBody body) {
    const Rows<Shape> found = shapes_of(body.object);
    if (found.empty()) return;
    const std::vector<Shape> shapes(found.begin(), found.end());
    if (body.robot != no_robot) body.link_pose = c.read(body.object, keys::pose);
    visit(std::as_const(body), Rows<Shape>(shapes));
  };
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    SceneBody body{.object = ObjectId(i)};
    if (c.robot_of(body.object) != no_robot) continue;
    body.scenery_pose = c.constant(body.object, keys::pose).value_or(Pose{});
    visit_body(std::move(body));
  }
  for (const RobotView* robot : c.robots()) {
    if (c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Link& link : robot->links) visit_body({.object = link.object, .robot = robot->id});
  }
}

}  // namespace muro::scene_bodies
