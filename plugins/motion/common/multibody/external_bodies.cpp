// SPDX-License-Identifier: MIT
#include "external_bodies.hpp"

#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/watch/watch.hpp"

namespace muro::multibody {

ExternalBody ExternalBodies::body_of(const Connector& c, ObjectId object) {
  ExternalBody body;
  body.name = c.object_name(object);
  for (const Shape& s : c.constant_array(object, keys::collision_shapes)) body.shapes.push_back({s, 0, object});
  return body;
}

void ExternalBodies::connect(Connector& c, const std::vector<bool>& own) {
  std::vector<bool> left_out(c.robots().size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!own[i]) continue;
    const Item& item = c.items()[i];
    left_out[index_of(item.robot->id)] = true;
    if (const auto original = c.constant(item.robot->base(), keys::shadow_of))  // both are in the same place
      if (const RobotId robot = c.robot_of(*original); robot != no_robot) left_out[index_of(robot)] = true;
  }
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    ExternalBody body = body_of(c, object);
    if (body.shapes.empty()) continue;
    body.pose = c.constant(object, keys::pose).value_or(Pose{});
    scenery_.push_back(std::move(body));
  }
  for (const RobotView* robot : c.robots()) {
    if (left_out[index_of(robot->id)] || c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Link& link : robot->links) {
      ExternalBody body = body_of(c, link.object);
      if (body.shapes.empty()) continue;
      RobotBody& b = robot_bodies_.emplace_back();
      b.body = std::move(body);
      b.pose = c.read(link.object, keys::pose);
      b.twist = c.read(link.object, keys::twist);
      b.contact_world = c.input(robot->base(), keys::contact_world, kinematic_world);
    }
  }
}

void ExternalBodies::add_to(World& world) {
  const auto add = [](const ExternalBody& body, const auto& how) {
    try {
      how();
    } catch (const Error& error) {
      throw Error(quote(body.name) + " is nothing that robots can touch: " + error.what());
    }
  };
  for (const ExternalBody& body : scenery_) add(body, [&] { world.add_static_body(body); });
  import();
  for (const RobotBody& b : robot_bodies_) add(b.body, [&] { world.add_kinematic_body(b.body, b.state); });
}

void ExternalBodies::import() {
  for (RobotBody& b : robot_bodies_) {
    b.state.motion_type = is_moved_by_forces(*b.contact_world) ? MotionType::disabled : MotionType::kinematic;
    b.state.pose = *b.pose;
    b.state.twist = *b.twist;
    if (!watch::is_somewhere(b.state.pose, b.state.twist))
      throw Error(quote(b.body.name) +
                  " has a pose or twist that is not finite, or no orientation; look at what moves it");
  }
}

}  // namespace muro::multibody
