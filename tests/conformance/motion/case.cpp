// SPDX-License-Identifier: MIT
#include "tests/conformance/motion/case.hpp"

#include <cstdio>

namespace muro::conformance {

Trial::Trial(const std::string& motion, double rate) : motion_(motion), rate_(rate) {}

void Trial::start(std::map<std::string, ParameterInput> parameters) {
  const Description& d = description_of(motion_);
  for (auto p = parameters.begin(); p != parameters.end();) {
    const bool known =
        std::any_of(d.parameters.begin(), d.parameters.end(), [&](const Parameter& k) { return k.name == p->first; });
    p = known ? std::next(p) : parameters.erase(p);
  }
  use(motion_, rate_, all_robots(), parameters);
  use_contacts();
  build();
}

void Trial::add_slope(double angle, double friction) { add_ground(friction, {Vec3::Zero(), from_rpy(0, -angle, 0)}); }

Wrench& Trial::push(const RobotView& robot) {
  PropertyStore& store = world().store();
  return *static_cast<Wrench*>(store.bind(store.add_party("the test"), robot.base(), keys::external_wrench,
                                          Access::accumulate, Form::single, 1, nullptr));
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const auto& some : {free_body_cases(), slope_cases(), rolling_cases(), impact_cases(), joint_cases(),
                           pendulum_cases(), vehicle_cases(), obstacle_cases(), mesh_cases()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::vector<std::string> motions() {
  std::vector<std::string> ids;
  for (const Offer& o : test::plugins().offers())
    if (o.kind == "motion") ids.push_back(o.id);
  return ids;
}

const Description& description_of(const std::string& motion) { return *test::plugins().algorithm(motion).description; }

Inertia solid_box(double mass, const Vec3& size) {
  const Vec3 q = size.cwiseAbs2() * (mass / 12);
  return {.mass = mass, .ixx = q.y() + q.z(), .iyy = q.x() + q.z(), .izz = q.x() + q.y()};
}

Shape with(Shape shape, double friction, double restitution) {
  shape.friction = friction;
  shape.restitution = restitution;
  return shape;
}

RobotTree block(double mass, const Vec3& size, double friction, double restitution) {
  return test::single_body(with(Shape::box(size), friction, restitution), solid_box(mass, size));
}

RobotTree ball(double mass, double radius, double friction, double restitution, double factor) {
  const double i = factor * mass * radius * radius;
  return test::single_body(with(Shape::sphere(radius), friction, restitution),
                           {.mass = mass, .ixx = i, .iyy = i, .izz = i});
}

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.7g", x);
  return buffer;
}

Outcome relative(double seen, double expected) {
  return {std::abs(seen - expected) / std::abs(expected), text(seen) + " for " + text(expected)};
}

}  // namespace muro::conformance
