// SPDX-License-Identifier: MIT
// Trees of bodies with random joints, for tests.
#pragma once

#include "model.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/randoms.hpp"

namespace muro::articulated::testing {

/// Returns a mass whose tensor of inertia has the principal moments of a solid box.
inline Inertia random_inertia(test::Randoms& random) {
  const double mass = random.uniform(0.2, 3), a = random.uniform(0.05, 0.4), b = random.uniform(0.05, 0.4),
               c = random.uniform(0.05, 0.4);
  const Mat3 axes = random.rotation().toRotationMatrix();
  const Vec3 moments = mass / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b);
  return Inertia::from(mass, random.uniform(0, 0.2) * random.direction(),
                       axes * moments.asDiagonal() * axes.transpose());
}

/// Returns a robot with hinges and slides on axes of frames and other axes, at places that are turned or not.
inline multibody::RobotModel random_robot(test::Randoms& random, int bodies, bool fixed) {
  multibody::RobotModel robot;
  robot.name = "r";
  robot.fixed_base = fixed;
  for (int i = 0; i < bodies; ++i) {
    multibody::RigidBody& body = robot.bodies.emplace_back();
    body.link = std::uint32_t(i);
    body.inertia = random_inertia(random);
    robot.mass += body.inertia.mass;
    robot.initial_positions.push_back(random.uniform(-1, 1));
    if (i == 0) continue;
    body.parent = random.below(3) > 0 ? i - 1 : random.below(i);
    body.joint = random.below(3) > 0 ? JointKind::revolute : JointKind::prismatic;
    body.origin.position = random.below(4) > 0 ? Vec3(random.uniform(0, 0.5) * random.direction()) : Vec3(0, 0, 0);
    const int turn = random.below(3);
    if (turn > 0) body.origin.orientation = turn == 1 ? random.right_angles() : random.rotation();
    body.axis =
        random.below(2) > 0 ? random.direction() : Vec3((random.below(2) * 2 - 1) * Vec3::Unit(random.below(3)));
    body.limits.armature = random.below(2) > 0 ? random.uniform(0, 0.1) : 0;
  }
  return robot;
}

}  // namespace muro::articulated::testing
