// SPDX-License-Identifier: MIT
// Contacts of a world: what they are set to before the solver runs, and what they did.
#pragma once

#include <deque>

#include "robot.hpp"
#include "settings.hpp"

namespace muro::mujoco {

/// What a geom belongs to.
struct Owner {
  std::int32_t robot = -1;  ///< of this world; -1: a fixture
  std::uint32_t part = 0;
  std::uint32_t body = 0;  ///< of the model, see PartShape
  double friction = 0, restitution = 0;
  /// Of what is posed from outside and has no degrees of freedom: pose and velocity, none where it rests.
  const Pose* pose = nullptr;
  const Twist* twist = nullptr;
};

class Contacts {
 public:
  /// `geoms`: how many the model has.
  void prepare(const Settings& settings, std::size_t geoms);
  Owner& owner_of(int geom) { return owners_[std::size_t(geom)]; }

  /// Friction of what has been found to touch.
  void set_friction(mjData& d);
  /// What the rows of contact `id`, from `row` on, aim at in a step of `dt` (s). mjData::efc_b holds the accelerations
  /// (m/s^2) of all rows without constraints.
  void set_reference(mjData& d, int id, int row, double dt);
  /// A convex solver lets what slides at s lift off at mu s (Anitescu, Optimization-based simulation of nonsmooth rigid
  /// multibody dynamics, 2006). This takes it off what the normal row aims at, as found for an `acceleration` of all
  /// degrees of freedom; solved again until that settles, contacts have Coulomb's friction (the fixed point of Cadoux
  /// on De Saxce's formulation). Returns the largest change (m/s^2).
  double release_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration);
  /// Adds what contacts did to the robots.
  void export_wrenches(const mjData& d, std::deque<Robot>& robots) const;

 private:
  Vec3 speed_of_fixtures(const mjContact& contact) const;

  struct Aim {
    double normal = 0;  ///< m/s^2, before sliding is released
    double grip = 0;    ///< m/s^2, of an impact: what friction would have to do to stop all sliding
  };

  Settings settings_;
  std::vector<Owner> owners_;  ///< one a geom
  std::vector<Aim> aims_;      ///< one a contact
  std::vector<mjtNum> rows_;   ///< scratch
};

}  // namespace muro::mujoco
