// SPDX-License-Identifier: MIT
// A world as a text in MJCF, MuJoCo's model format.
#pragma once

#include <map>
#include <string>

#include "mujoco_library.hpp"
#include "mujoco_meshes.hpp"
#include "mujoco_settings.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::mujoco {

/// Sizes of the engine's buffers.
struct Sizes {
  int contacts = 0;  ///< nconmax
  int rows = 0;      ///< njmax: rows of constraints
};

/// Writes a world, body by body. Bodies and joints have the name `body_name`; the geoms of a body are in the order of
/// its shapes.
class Mjcf {
 public:
  /// Place of contact parameters: as defaults of a whole text, or in each geom for elements of another file. Parameters
  /// in geoms are MuJoCo's own, with the surface of the shape.
  enum class Contacts { by_default, of_each_geom };
  explicit Mjcf(const MujocoMeshes& meshes, Contacts contacts = Contacts::by_default);

  /// Returns the name of a body. `owner`: number of the external body or robot; `name`: its name, for messages.
  static std::string body_name(std::string_view name, std::size_t owner, std::size_t number);

  /// Returns the name of a body's geom. `number`: counts only shapes that become geoms.
  static std::string geom_name(const std::string& body, std::size_t number);

  /// Adds a body at rest. Planes and heightmaps belong to the world's body. When only a few geoms move, other shapes
  /// belong to it, too, and MuJoCo tests each against the moving geoms. When more geoms move, each object is a body of
  /// its own, and MuJoCo sorts the bodies.
  void add_static_body(const multibody::ExternalBody& body, std::size_t owner);
  /// Adds a body that is posed from outside (mocap).
  void add_kinematic_body(const multibody::ExternalBody& body, std::size_t owner);
  /// Adds a tree of bodies. A free base has its frame in its centre of mass; any other body has the frame of the model.
  /// A fixed base is posed from outside.
  void add_robot(const multibody::RobotModel& model, std::size_t owner);

  /// Returns the whole text.
  std::string text(const MujocoSettings& settings, const Sizes& sizes) const;
  /// Returns the added bodies as elements for the end of another file.
  std::string elements() const;
  /// Writes the heights of heightmaps into a model compiled with these elements.
  void fill_height_fields(mjModel& model) const;

 private:
  void write_body(const multibody::RobotModel& model, std::size_t number, std::size_t owner);
  std::string number(double value) const;
  std::string attribute(const char* name, std::initializer_list<double> values) const;
  std::string vector(const char* name, const Vec3& v) const;
  std::string place(const Pose& pose) const;
  std::string own_contacts(const Surface& s) const;
  std::string terrain(const Shape& shape, Pose& pose);
  std::string geom(const multibody::BodyShape& shape, Pose pose, const std::string& name);

  const MujocoMeshes* meshes_;
  Contacts contacts_;
  /// MuJoCo reads numbers from a stream in the C++ locale of its process: the locale of the program that embeds muro,
  /// or "C" in the parser process.
  char decimal_sign_;
  static constexpr std::size_t few_geoms = 15;

  std::string ground_, scenery_in_world_, scenery_in_bodies_, bodies_, assets_, exclusions_, tendons_, equalities_;
  std::size_t moving_geoms_ = 0;
  std::map<const Vec3*, std::string> mesh_names_;
  std::vector<Heightmap> height_fields_;  ///< by number, which is part of the name
};

/// The principal moments (kg m^2) of an inertia, and their axes as a rotation.
struct Principal {
  Vec3 moments;
  Quat axes;
};
Principal principal_of(const Inertia& inertia);

/// Whether Coulomb friction of a body's joint has a row in addition to that of its drive: a tendon of this joint alone.
inline bool has_friction_beside_drive(const multibody::RigidBody& body) {
  return body.drive == DriveMode::position && body.leader < 0 && body.limits.friction > 0;
}

/// Whether a shape is unbounded below and stands still.
inline bool is_ground(const Shape& s) { return s.kind == ShapeKind::plane || s.kind == ShapeKind::heightmap; }

/// Whether the shape of a moving body becomes a geom: in MuJoCo, ground cannot move.
inline bool has_geom(const multibody::BodyShape& s) { return !is_ground(s.shape); }

}  // namespace muro::mujoco
