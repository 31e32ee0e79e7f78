// SPDX-License-Identifier: MIT
#include "mounted.hpp"

#include <string>

#include "muro/base/did_you_mean.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::internal_sensor {

namespace {

ObjectId carrier_of(const Connector& c, const Item& item) {
  return c.constant(item.object, keys::sensor_link).value_or(item.robot->base());
}

std::string name_in_robot(const Connector& c, const RobotView& robot, ObjectId object) {
  return std::string(c.object_name(object).substr(robot.name.size() + 1));
}

std::vector<std::string> joint_names(const Connector& c, const RobotView& robot) {
  std::vector<std::string> names;
  for (const Link& l : robot.links)
    if (l.joint != JointKind::fixed) names.push_back(name_in_robot(c, robot, l.joint_object));
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + quote(n);
  return all.empty() ? "none" : all;
}

bool fits(std::string_view pattern, std::string_view name) {
  if (pattern.empty() || pattern.back() != '*') return pattern == name;
  return name.starts_with(pattern.substr(0, pattern.size() - 1));
}

}  // namespace

std::uint32_t carrying_link(const Connector& c, const Item& item) {
  const ObjectId carrier = carrier_of(c, item);
  const Rows<Link> links = item.robot->links;
  for (std::uint32_t i = 0; i < links.size(); ++i)
    if (links[i].object == carrier) return i;
  for (const Link& l : links)
    if (l.joint_object == carrier)
      throw Error("it is mounted on " + quote(name_in_robot(c, *item.robot, carrier)) +
                  ", which is a joint; name a link, such as " + quote(name_in_robot(c, *item.robot, l.object)) +
                  ", with `on`");
  throw Error(quote(c.object_name(carrier)) + " is no link of the robot; name a link with `on`");
}

std::uint32_t carrying_link_or_joint(const Connector& c, const Item& item) {
  const ObjectId carrier = carrier_of(c, item);
  for (std::uint32_t i = 0; i < item.robot->links.size(); ++i)
    if (const Link& l = item.robot->links[i]; l.joint != JointKind::fixed && l.joint_object == carrier) return i;
  return carrying_link(c, item);
}

std::vector<std::uint32_t> sensed_joints(const Connector& c, const Item& item, std::string_view parameter) {
  const std::span<const std::string_view> patterns = c.parameters().texts(parameter);
  if (patterns.empty()) return {carrying_joint(c, item)};
  const std::vector<std::string> names = joint_names(c, *item.robot);
  for (const std::string_view pattern : patterns) {
    const auto is_one = [&](const std::string& name) { return fits(pattern, name); };
    if (std::none_of(names.begin(), names.end(), is_one))
      throw Error("`" + std::string(parameter) + "` names " + quote(pattern) + ", but the robot has no such joint" +
                  did_you_mean(pattern, names) + "; its joints are: " + listed(names));
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < item.robot->links.size(); ++i) {
    const Link& l = item.robot->links[i];
    if (l.joint == JointKind::fixed) continue;
    const std::string name = name_in_robot(c, *item.robot, l.joint_object);
    if (std::any_of(patterns.begin(), patterns.end(), [&](std::string_view p) { return fits(p, name); }))
      found.push_back(i);
  }
  return found;
}

std::uint32_t carrying_joint(const Connector& c, const Item& item) {
  const ObjectId carrier = carrier_of(c, item);
  for (std::uint32_t i = 0; i < item.robot->links.size(); ++i)
    if (const Link& l = item.robot->links[i]; l.joint != JointKind::fixed && l.joint_object == carrier) return i;
  throw Error("it looks at a joint, but is mounted on " + quote(name_in_robot(c, *item.robot, carrier)) +
              "; name a joint with `on`; those of the robot are: " + listed(joint_names(c, *item.robot)));
}

link_motion::LinkMotion device_motion(Connector& c, const Item& item, link_motion::Order order) {
  const Pose mounting = mounting_of(c.parameters());
  c.set(item.object, keys::sensor_origin, mounting);
  return {c, *item.robot, carrying_link(c, item), mounting, order};
}

Vec3 gravity_of(const Connector& c) { return c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81)); }

}  // namespace muro::internal_sensor
