// SPDX-License-Identifier: MIT
// A world as a text in MJCF, MuJoCo's format of models.
#pragma once

#include <map>
#include <string>

#include "meshes.hpp"
#include "plugins/common/multibody/world.hpp"
#include "settings.hpp"

namespace muro::mujoco {

/// How big the engine's buffers are.
struct Sizes {
  int contacts = 0;  ///< nconmax
  int rows = 0;      ///< njmax: of constraints
};

/// Writes a world, body by body. Bodies and joints have the name `body_name`; the geoms of a body stand in the order of
/// its shapes.
class Mjcf {
 public:
  explicit Mjcf(const Meshes& meshes) : meshes_(&meshes) {}

  /// `owner`: number of the fixture or robot, `name`: of it, for messages.
  static std::string body_name(std::string_view name, std::size_t owner, std::size_t part);

  /// The geom of a body's shape `number`, of those that become geoms.
  static std::string geom_name(const std::string& body, std::size_t number);

  /// At rest. Planes belong to the world's body. So do all others beside a few geoms that move, which are tried with
  /// each of them; beside more, each object is a body, which MuJoCo sorts.
  void add_scenery(const multibody::Fixture& fixture, std::size_t owner);
  /// A body that is posed from outside (mocap).
  void add_obstacle(const multibody::Fixture& fixture, std::size_t owner);
  /// A tree of bodies. A free base has its frame in its centre of mass, any other part has that of the model; a fixed
  /// base is posed from outside.
  void add_robot(const multibody::RobotModel& model, std::size_t owner);

  /// The whole text.
  std::string text(const Settings& settings, const Sizes& sizes) const;

 private:
  void write_part(const multibody::RobotModel& model, std::size_t part, std::size_t owner);
  std::string geom(const multibody::PartShape& shape, const Pose& pose, const std::string& name);

  const Meshes* meshes_;
  static constexpr std::size_t few_geoms = 15;

  std::string planes_, scenery_in_world_, scenery_in_bodies_, bodies_, assets_, exclusions_;
  std::size_t moving_geoms_ = 0;
  std::map<const Vec3*, std::string> mesh_names_;
};

/// The principal moments (kg m^2) of an inertia, and their axes as a rotation.
struct Principal {
  Vec3 moments;
  Quat axes;
};
Principal principal_of(const Inertia& inertia);

/// Whether the shape of a body that moves becomes a geom: MuJoCo has planes at rest only.
inline bool has_geom(const multibody::PartShape& s) { return s.shape.kind != ShapeKind::plane; }

}  // namespace muro::mujoco
