// SPDX-License-Identifier: MIT
// Contacts of a world: their settings before the solver runs, and their forces after it.
#pragma once

#include <deque>

#include "contact_cells.hpp"
#include "mujoco_robot.hpp"
#include "mujoco_settings.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/common/contact_geometry/terrain/terrain_contacts.hpp"

namespace muro::mujoco {

/// The owner of a geom.
struct GeomOwner {
  std::int32_t robot = -1;        ///< robot of this world; -1: an external body
  std::uint32_t body = 0;         ///< body of the robot
  std::uint32_t loaded_link = 0;  ///< see BodyShape
  ObjectId object = no_object;    ///< object that has the shape
  Surface surface;
  contact_geometry::ShapeExtent extent;
  terrain_contact::ConvexShape convex;   ///< for a robot: shape that touches heightmaps
  Pose in_body;                          ///< for a robot: pose of the shape in the frame of its body in MuJoCo
  const std::string* scenery = nullptr;  ///< its name; null for moving bodies
  /// Pose and velocity of a body that is posed from outside and has no degrees of freedom; null when it rests.
  const Pose* pose = nullptr;
  const Twist* twist = nullptr;
};

class MujocoContacts {
 public:
  /// Prepares for a model. `geoms`: number of its geoms.
  void prepare(const MujocoSettings& settings, std::size_t geoms);
  GeomOwner& owner_of(int geom) { return owners_[std::size_t(geom)]; }

  /// Reports overlaps with scenery to the robots.
  void report_overlaps(const mjData& d, std::deque<MujocoRobot>& robots) const;
  /// Adds the heightmap at `pose` that `geom` represents.
  void add_terrain(int geom, const Heightmap& map, const Pose& pose) { terrains_.push_back({geom, map, pose}); }

  /// Adds the contacts of robots with heightmaps to the contacts that MuJoCo has found.
  void find_terrain_contacts(const mjModel& m, mjData& d, const std::deque<MujocoRobot>& robots) const;
  /// Sets the friction of the contacts that were found.
  void set_friction(mjData& d);
  /// Moves friction to the middle of the cells. Call it when rows have been made.
  void move_friction(const mjModel& m, mjData& d) { cells_.move_friction(m, d); }
  /// Sets the target accelerations of the rows of contact `id`, starting at `row`, in a step of `dt` (s). mjData::efc_b
  /// holds the accelerations (m/s^2) of all rows without constraints.
  void set_reference(const mjModel& m, mjData& d, int id, int row, double dt);
  /// Corrects the targets of sliding contacts. With a convex solver, a contact that slides at s lifts off at mu s
  /// (Anitescu, Optimization-based simulation of nonsmooth rigid multibody dynamics, 2006). This subtracts the lift
  /// from the target of the normal row, for a given `acceleration` of all degrees of freedom. Repeated solutions
  /// converge to Coulomb's friction (the fixed point of Cadoux on De Saxce's formulation). Returns the largest change
  /// (m/s^2).
  ///
  /// When a patch spins, the ends of a cell move relative to its middle. While the middle is slower than the ends,
  /// friction is reduced by the ratio of these speeds: the rows are softened for this. `is_solved`: whether the rows
  /// have their forces for this acceleration.
  double correct_for_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration, bool is_solved);
  /// Removes the correction of overlaps from the targets of rows. Call it after the solver. Returns whether this
  /// changes anything.
  bool leave_overlaps(mjData& d);
  /// Adds the forces of contacts to the robots.
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
    double normal = 0;          ///< m/s^2, before the correction for sliding
    double max_lift = 0;        ///< m/s^2, of an impact: lift when all sliding stops
    double recovery = 0;        ///< m/s^2: part of `normal` that corrects an overlap and must not stay in velocities
    double least_softness = 0;  ///< 1/kg, of its friction
    double ends = 0;            ///< m/s^2: stops the ends of the cell relative to its middle within the step
  };

  MujocoSettings settings_;
  std::vector<GeomOwner> owners_;  ///< one per geom
  std::vector<Terrain> terrains_;
  ContactCells cells_;
  std::vector<Reference> references_;  ///< one per contact
  std::vector<mjtNum> rows_;           ///< scratch
};

}  // namespace muro::mujoco
