// SPDX-License-Identifier: MIT
#include "bodies.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

#include "apparent_mass.hpp"
#include "muro/base/random.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/vocabulary/contact.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::penalty {

void Bodies::connect(Connector& c) {
  all.resize(c.object_count());
  bool resists_turning = false;
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    names.emplace_back(c.object_name(ObjectId{i}));
    all[i].name = fnv1a(names[i]);
    all[i].model = i;
    all[i].first_shape = std::uint32_t(shapes.size());
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) {
      shapes.push_back(contact_geometry::extent_of(s));
      resists_turning = resists_turning || s.surface.rolling_resistance > 0 || s.surface.spinning_resistance > 0;
      if (std::none_of(materials.begin(), materials.end(),
                       [&](const Material& m) { return m.restitution == s.surface.restitution; }))
        materials.push_back({s.surface.restitution, damping_ratio_of(s.surface.restitution)});
    }
  }
  robot_of.assign(c.robots().size(), not_dynamic);
  for (const RobotView* robot : c.robots()) connect_robot(c, *robot, resists_turning);
  if (!robots.empty()) connect_kinematic_robots(c);
  by_order_key.resize(robots.size());
  std::iota(by_order_key.begin(), by_order_key.end(), 0u);
  sort_by_order_key(by_order_key);
}

/// A single link rests 0.2 mm deep if steps are long. A robot with joints presses with its drives, not with the weight
/// of the link that touches. So it is solved as soon as a contact stays deeper than it should.
bool Bodies::is_solved_alone(const StepContext& context, std::uint32_t number) const {
  constexpr double deep = 2e-4, very_deep = 1e-3, slow = 0.01;  // m, m/s
  const Robot& robot = robots[number];
  if (robot.is_one_link) return is_soft(context);
  if (robot.is_single_body) return false;
  if (!(*robot.solved).empty()) return true;
  return std::any_of((*robot.contacts).begin(), (*robot.contacts).end(), [&](const Contact& c) {
    const auto approach = [&] { return c.normal.dot(velocity(c.other, c.point) - velocity(c.self, c.point)); };
    return c.depth > very_deep || (c.depth > deep && std::abs(approach()) < slow);
  });
}

void Bodies::sort_by_order_key(std::vector<std::uint32_t>& numbers) const {
  std::sort(numbers.begin(), numbers.end(), [this](std::uint32_t a, std::uint32_t b) {
    return std::tuple(robots[a].order_key, a) < std::tuple(robots[b].order_key, b);
  });
}

void Bodies::connect_kinematic_robots(Connector& c) {
  for (const RobotView* view : c.robots()) {
    if (robot_of[index_of(view->id)] != not_dynamic || c.constant(view->base(), keys::shadow_of)) continue;
    const auto has_shapes = [&](const Link& link) {
      return !c.constant_array(link.object, keys::collision_shapes).empty();
    };
    if (std::none_of(view->links.begin(), view->links.end(), has_shapes)) continue;
    for (const Link& link : view->links)
      all[index_of(link.object)].kinematic_robot = std::int32_t(kinematic_robots.size());
    kinematic_robots.push_back({view->base(), c.derived_list(view->base(), keys::contact_wrenches_of_law)});
  }
}

void Bodies::connect_by_name(Connector& c) {
  for (const RobotView* robot : c.robots()) connect_links(c, *robot);
  const auto is_read = [&](ObjectId base) { return c.is_used(base, keys::contact_wrenches_of_law, usage::read); };
  for (const RobotView* robot : c.robots()) {
    if (robot_of[index_of(robot->id)] == not_dynamic || !is_read(robot->base())) continue;
    tells_contacts = true;
    tells_kinematic_robots =
        tells_kinematic_robots || !c.constant_array(robot->base(), keys::motion_level_names).empty();
  }
  for (KinematicRobot& robot : kinematic_robots) {
    robot.is_read = is_read(robot.base);
    tells_contacts = tells_contacts || robot.is_read;
    tells_kinematic_robots = tells_kinematic_robots || robot.is_read;
  }
}

void Bodies::connect_robot(Connector& c, const RobotView& view, bool resists_turning) {
  const bool moved = c.is_used(view.base(), keys::external_wrench, usage::read_sum);
  for (const Link& link : view.links) {
    Body& b = all[index_of(link.object)];
    b.model = index_of(view.base());
    b.robot = moved ? std::int32_t(robots.size()) : not_dynamic;
    if (c.constant_array(link.object, keys::collision_shapes).empty()) continue;
    b.pose = c.read(link.object, keys::pose).get();
    b.twist = c.read(link.object, keys::twist).get();
  }
  if (!moved) return;
  if (!(composite_inertia(view.links, inertias_of(c, view), initial_joint_positions(c, view)).mass > 0))
    throw Error(quote(view.name) + " has no mass, so no contact can push it; give its bodies `inertial`");
  Robot r;
  r.contacts = c.read_list(view.base(), keys::contacts);
  r.anchors = {c.variable_list(view.base(), anchors), c.variable_list(view.base(), anchor_details)};
  r.solved = c.variable_list(view.base(), solved_contacts);
  r.told = c.derived_list(view.base(), keys::contact_wrenches_of_law);
  if (resists_turning) r.turning_springs = c.variable_list(view.base(), turning_springs);
  r.world = c.input(view.base(), keys::contact_world, kinematic_world);
  r.lag = c.input(view.base(), keys::twist_lag, 0.0);
  r.order_key = view.key;
  r.is_shadow = c.constant(view.base(), keys::shadow_of).has_value();
  robot_of[index_of(view.id)] = std::int32_t(robots.size());
  robots.push_back(r);
  apparent_masses.emplace_back();
}

/// Connects the bodies of a robot that forces move: its base and the links on which its motion reads forces.
void Bodies::connect_links(Connector& c, const RobotView& view) {
  if (robot_of[index_of(view.id)] == not_dynamic) return;
  Robot& r = robots[std::size_t(robot_of[index_of(view.id)])];
  r.first_body = std::uint32_t(dynamic_bodies.size());
  std::vector<std::uint32_t> links{0};
  for (std::uint32_t i = 0; i < view.links.size(); ++i) {
    const ObjectId object = view.links[i].object;
    Body& b = all[index_of(object)];
    b.dynamic_body = r.first_body;
    if (i == 0 || c.constant_array(object, keys::collision_shapes).empty() ||
        !c.is_used(object, keys::external_wrench, usage::read_sum))
      continue;
    b.dynamic_body = r.first_body + std::uint32_t(links.size());
    links.push_back(i);
  }
  r.body_count = std::uint32_t(links.size());
  r.is_single_body = links.size() == 1;
  r.is_one_link = view.links.size() == 1;
  if (r.is_single_body && c.is_used(view.base(), keys::impact_time, usage::input)) {
    r.impact_step = c.read(view.base(), keys::impact_step);
    r.impact_time = c.write(view.base(), keys::impact_time);
    r.impact = c.write(view.base(), keys::impact);
  }
  if (c.is_used(view.base(), keys::carried_mass, usage::input))
    r.carried_mass = c.write(view.base(), keys::carried_mass);
  const std::vector<Inertia> inertias = inertias_of(c, view);
  const std::vector<double> positions = initial_joint_positions(c, view);
  const Inertia composite = composite_inertia(view.links, inertias, positions);
  r.mass = composite.mass;
  if (r.is_single_body) return add_dynamic_body(c, view.base(), mass_properties_of(composite));
  const ApparentMasses& apparent = apparent_masses[std::size_t(robot_of[index_of(view.id)])] =
      penalty::apparent_masses(view.links, inertias, positions, links);
  for (std::size_t i = 0; i < links.size(); ++i) add_dynamic_body(c, view.links[links[i]].object, apparent.bodies[i]);
}

void Bodies::add_dynamic_body(Connector& c, ObjectId body, const MassProperties& mass) {
  dynamic_bodies.push_back({c.accumulate(body, keys::external_wrench), c.read(body, keys::pose),
                            c.read(body, keys::twist), number_of(mass)});
}

std::uint32_t Bodies::number_of(const MassProperties& mass) {
  const auto found = std::find(masses.begin(), masses.end(), mass);
  if (found != masses.end()) return std::uint32_t(found - masses.begin());
  masses.push_back(mass);
  return std::uint32_t(masses.size() - 1);
}

}  // namespace muro::penalty
