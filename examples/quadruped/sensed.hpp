// SPDX-License-Identifier: MIT
// Readings of the sensors in a level frame with the heading of the body.
#pragma once

#include <array>
#include <span>

#include "../common/vector.hpp"
#include "angles.hpp"
#include "estimate.hpp"
#include "leg.hpp"
#include "model.hpp"

namespace quadruped {

/// Raw readings: joints as the robot has them, orientation x y z w, the rest in the frame of the body.
struct Readings {
  std::span<const double> position, velocity;                   ///< rad, rad/s: 12 each
  std::span<const double> orientation, rotation, acceleration;  ///< 1, rad/s, m/s^2 (specific force)
  std::span<const double> contact;                              ///< 1: the foot stands; empty: unknown
};

struct Sensed {
  Rotation level;                          ///< from the frame of the body to the level frame
  Angles attitude;                         ///< rad
  Vector rotation;                         ///< rad/s
  Vector force;                            ///< m/s^2, specific force
  std::array<Vector, legs> angles, rates;  ///< rad, rad/s
  /// Jacobians of the middle of each foot, and of its lowest point; frame of the body.
  std::array<Leg::Jacobian, legs> jacobians, contacts;
  std::array<FootState, legs> feet;
  std::array<bool, legs> touches;
  bool feels;  ///< whether the feet measure contacts

  Sensed(const Model& model, const Readings& r) {
    const Rotation body = Rotation::of(r.orientation);
    attitude = Angles::of(body);
    level = levelled(body, attitude.yaw);
    const Vector turning{r.rotation[0], r.rotation[1], r.rotation[2]};
    rotation = level * turning;
    force = level * Vector{r.acceleration[0], r.acceleration[1], r.acceleration[2]};
    feels = !r.contact.empty();
    const Vector below = level.inverse() * Vector{0, 0, -model.foot_radius};
    for (int i = 0; i < legs; ++i) {
      const std::size_t at = std::size_t(i);
      const Leg& leg = model.leg[at];
      angles[at] = model.joints.angles(i, r.position);
      rates[at] = model.joints.rates(i, r.velocity);
      jacobians[at] = leg.jacobian(angles[at]);
      contacts[at] = leg.jacobian(angles[at], below);
      const Vector foot = leg.hip + leg.foot(angles[at]);
      feet[at].position = level * foot;
      feet[at].velocity = level * (contacts[at] * rates[at] + cross(turning, foot + below));
      touches[at] = feels && r.contact[std::size_t(model.joints.place[at])] > 0.5;
    }
  }

  /// Returns the centre of mass of the robot, frame of the body, m.
  Vector center_of_mass(const Model& model) const {
    const double of_leg = model.leg_masses.sum();
    Vector sum = (model.mass - legs * of_leg) * model.center;
    for (std::size_t i = 0; i < legs; ++i)
      sum = sum + of_leg * model.leg[i].hip + model.leg[i].moment(angles[i], model.leg_masses);
    return (1 / model.mass) * sum;
  }
};

}  // namespace quadruped
