// SPDX-License-Identifier: MIT
// Scenes of motion.articulated, for tests.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::articulated::testing {

inline constexpr double g = 9.81;  ///< m/s^2
using Parameters = std::map<std::string, ParameterInput>;

struct World : test::Scene {
  /// Starts the motion with all robots so far, at 1 kHz.
  void start(Parameters parameters = {}, double rate = 1000) {
    start(
        std::move(parameters), [] {}, rate);
  }
  /// Starts the motion. `add_others` adds what this motion does not move.
  void start(Parameters parameters, const std::function<void()>& add_others, double rate = 1000) {
    use("motion.articulated", rate, all_robots(), std::move(parameters));
    add_others();
    use_contacts();
    build();
  }
  double& of(const std::string& joint, const Key<double>& key) { return world().value(joint, key); }
  double q(const std::string& joint) { return of(joint, keys::joint_position); }
  double v(const std::string& joint) { return of(joint, keys::joint_velocity); }
  /// Returns the sum of the contact forces on the links of a robot (N).
  Vec3 contact_force(const RobotView& robot) {
    Vec3 sum = Vec3::Zero();
    for (const Link& link : robot.links)
      if (world().store().find(link.object, keys::contact_wrench.name))
        sum += world().value(link.object, keys::contact_wrench).force;
    return sum;
  }
};

/// Returns the mass of all links (kg).
inline double mass_of(World& w, const RobotView& robot) {
  double sum = 0;
  for (const Link& link : robot.links)
    if (w.world().store().find(link.object, keys::inertial.name))
      sum += w.world().value(link.object, keys::inertial).mass;
  return sum;
}

/// Momentum and energy of a robot. Its links are up to date (refresh).
struct Motion {
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();  ///< about the origin
  double kinetic = 0, potential = 0;                     ///< J; potential energy is 0 at z = 0
};
inline Motion motion_of(World& w, const RobotView& robot) {
  Motion m;
  for (const Link& link : robot.links) {
    if (!w.world().store().find(link.object, keys::inertial.name)) continue;
    const Inertia inertia = w.world().value(link.object, keys::inertial);
    const Pose pose = w.world().value(link.object, keys::pose);
    const Twist twist = w.world().value(link.object, keys::twist);
    const Mat3 axes = pose.orientation.toRotationMatrix();
    const Vec3 centre = pose * inertia.com, velocity = twist.at(centre - pose.position);
    const Vec3 spin = axes * inertia.tensor() * axes.transpose() * twist.angular;
    m.momentum += inertia.mass * velocity;
    m.angular += inertia.mass * centre.cross(velocity) + spin;
    m.kinetic += 0.5 * inertia.mass * velocity.squaredNorm() + 0.5 * twist.angular.dot(spin);
    m.potential += inertia.mass * g * centre.z();
  }
  return m;
}

}  // namespace muro::articulated::testing
