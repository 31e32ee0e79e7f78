// SPDX-License-Identifier: MIT
// Contacts of a world: what they are set to before the solver runs, and what they did.
#pragma once

#include <deque>

#include "mujoco_robot.hpp"
#include "mujoco_settings.hpp"

namespace muro::mujoco {

/// What a geom belongs to.
struct GeomOwner {
  std::int32_t robot = -1;        ///< of this world; -1: an external body
  std::uint32_t body = 0;         ///< of the robot
  std::uint32_t loaded_link = 0;  ///< see BodyShape
  Surface surface;
  const std::string* scenery = nullptr;  ///< its name; null for what moves
  /// Of what is posed from outside and has no degrees of freedom: pose and velocity, none where it rests.
  const Pose* pose = nullptr;
  const Twist* twist = nullptr;
};

class MujocoContacts {
 public:
  /// `geoms`: how many the model has.
  void prepare(const MujocoSettings& settings, std::size_t geoms);
  GeomOwner& owner_of(int geom) { return owners_[std::size_t(geom)]; }

  /// Tells robots how deep they are in scenery.
  void report_overlaps(const mjData& d, std::deque<MujocoRobot>& robots) const;
  /// Friction of what has been found to touch.
  void set_friction(mjData& d);
  /// What the rows of contact `id`, from `row` on, aim at in a step of `dt` (s). mjData::efc_b holds the accelerations
  /// (m/s^2) of all rows without constraints.
  void set_reference(mjData& d, int id, int row, double dt);
  /// A convex solver lets what slides at s lift off at mu s (Anitescu, Optimization-based simulation of nonsmooth rigid
  /// multibody dynamics, 2006). This takes it off what the normal row aims at, as found for an `acceleration` of all
  /// degrees of freedom; solved again until that settles, contacts have Coulomb's friction (the fixed point of Cadoux
  /// on De Saxce's formulation). Returns the largest change (m/s^2).
  double correct_for_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration);
  /// Adds what contacts did to the robots.
  void export_wrenches(const mjData& d, std::deque<MujocoRobot>& robots) const;

 private:
  Vec3 external_velocity(const mjContact& contact) const;

  struct Reference {
    double normal = 0;        ///< m/s^2, before the correction for sliding
    double max_friction = 0;  ///< m/s^2, of an impact: what friction would have to do to stop all sliding
  };

  MujocoSettings settings_;
  std::vector<GeomOwner> owners_;      ///< one per geom
  std::vector<Reference> references_;  ///< one per contact
  std::vector<mjtNum> rows_;           ///< scratch
};

}  // namespace muro::mujoco
