// SPDX-License-Identifier: MIT
// Contacts of a world: what they are set to before the solver runs, and what they did.
#pragma once

#include <deque>

#include "contact_cells.hpp"
#include "mujoco_robot.hpp"
#include "mujoco_settings.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/common/contact_geometry/terrain/terrain_contacts.hpp"

namespace muro::mujoco {

/// What a geom belongs to.
struct GeomOwner {
  std::int32_t robot = -1;        ///< of this world; -1: an external body
  std::uint32_t body = 0;         ///< of the robot
  std::uint32_t loaded_link = 0;  ///< see BodyShape
  ObjectId object = no_object;    ///< that has the shape
  Surface surface;
  contact_geometry::ShapeExtent extent;
  terrain_contact::ConvexShape convex;   ///< of a robot: what touches heightmaps
  Pose in_body;                          ///< of a robot: of the shape, from the frame of its body in MuJoCo
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
  /// `geom` is a heightmap at `pose`.
  void add_terrain(int geom, const Heightmap& map, const Pose& pose) { terrains_.push_back({geom, map, pose}); }

  /// Adds the contacts of robots with heightmaps to those that MuJoCo has found.
  void find_terrain_contacts(const mjModel& m, mjData& d, const std::deque<MujocoRobot>& robots) const;
  /// Friction of what has been found to touch.
  void set_friction(mjData& d);
  /// When rows have been made: where friction acts.
  void move_friction(const mjModel& m, mjData& d) { cells_.move_friction(m, d); }
  /// What the rows of contact `id`, from `row` on, aim at in a step of `dt` (s). mjData::efc_b holds the accelerations
  /// (m/s^2) of all rows without constraints.
  void set_reference(const mjModel& m, mjData& d, int id, int row, double dt);
  /// A convex solver lets what slides at s lift off at mu s (Anitescu, Optimization-based simulation of nonsmooth rigid
  /// multibody dynamics, 2006). This takes it off what the normal row aims at, as found for an `acceleration` of all
  /// degrees of freedom; solved again until that settles, contacts have Coulomb's friction (the fixed point of Cadoux
  /// on De Saxce's formulation). Returns the largest change (m/s^2).
  ///
  /// Where a patch spins, the ends of a cell move against its middle, and as long as they move faster than that, the
  /// cell does as much less than its limit as its middle is slower. Its rows get a softness that does this.
  /// `is_solved`: the rows have their forces for this acceleration.
  double correct_for_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration, bool is_solved);
  /// After the solver: leaves what takes overlaps back out of what rows aim at. Returns whether that changes anything.
  bool leave_overlaps(mjData& d);
  /// Adds what contacts did to the robots.
  void export_wrenches(const mjData& d, std::deque<MujocoRobot>& robots) const;

 private:
  /// m/s and rad/s along and about the axes of a contact.
  using ContactVelocity = Eigen::Matrix<double, 6, 1>;
  ContactVelocity external_velocity(const mjContact& contact, const ContactCell& cell) const;
  double soften(mjData& d, int id, double pressure) const;
  double lighter_mass(const mjModel& m, const mjContact& contact) const;

  struct Terrain {
    int geom;
    Heightmap map;
    Pose pose;
  };

  struct Reference {
    double normal = 0;    ///< m/s^2, before the correction for sliding
    double max_lift = 0;  ///< m/s^2, of an impact: what stopping all sliding would lift
    double recovery = 0;  ///< m/s^2: the part of `normal` that takes an overlap back and that velocities shall not keep
    double least_softness = 0;  ///< 1/kg, of its friction
    double ends = 0;            ///< m/s^2: what stops the ends of the cell against its middle within the step
  };

  MujocoSettings settings_;
  std::vector<GeomOwner> owners_;  ///< one per geom
  std::vector<Terrain> terrains_;
  ContactCells cells_;
  std::vector<Reference> references_;  ///< one per contact
  std::vector<mjtNum> rows_;           ///< scratch
};

}  // namespace muro::mujoco
