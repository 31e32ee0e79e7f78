// SPDX-License-Identifier: MIT
// Reads a mesh file as a model of one body.
#include <algorithm>

#include "muro/base/limits.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "plugins/common/mesh/hull.hpp"
#include "plugins/common/mesh/solid.hpp"

namespace {

using namespace muro;

constexpr std::string_view extensions[] = {".stl", ".obj", ".dae", ".glb", ".gltf", ".ply"};
constexpr ReaderDescription description{
    .id = "reader.mesh",
    .version = "1.0.0",
    .summary = "Reads a mesh file as a homogeneous body with the density of water",
    .extensions = extensions,
};

constexpr double density = 1000;  ///< kg/m^3: MuJoCo's default

class MeshReader final : public ModelReader {
 public:
  void read(std::string_view path, RobotBuilder& builder) override {
    const mesh::Mesh mesh = mesh::load(std::string(path), Vec3::Ones());
    builder.base("body");
    const Shape shape{.kind = ShapeKind::mesh, .mesh = builder.intern(path), .size = Vec3::Ones()};
    builder.set_array(keys::collision_shapes, std::span(&shape, 1));
    builder.set_array(keys::visual_shapes, std::span(&shape, 1));
    try {
      const mesh::Hull hull = mesh::convex_hull(mesh.vertices);
      builder.set_array(keys::mesh_corners, std::span<const Vec3>(hull.vertices));
      set_inertia(mesh::solid_inertia(mesh::is_closed(mesh) ? mesh : surface_of(hull), density), builder);
    } catch (const Error&) {  // a flat mesh has no volume: only its corners are set
      builder.set_array(keys::mesh_corners, std::span<const Vec3>(mesh.vertices));
    }
  }

 private:
  /// Clamps the mass, with a warning: a mesh in millimetres is far too heavy before a model scales it.
  static void set_inertia(const Inertia& water, RobotBuilder& builder) {
    const double mass = std::clamp(water.mass, limits::min_mass, limits::max_mass);
    if (mass != water.mass)
      builder.report(Severity::warning,
                     "a body of water with this volume has no mass from 1e-9 to 1e9 kg and gets the nearest of these; "
                     "are its coordinates in metres?");
    builder.set(keys::inertial, Inertia::from(mass, water.com, mass / water.mass * water.tensor()));
  }
};

constexpr abi::ReaderEntry readers[] = {model_reader<MeshReader>(description)};

}  // namespace

MURO_PLUGIN(.name = "reader_mesh", .version = description.version, .licence = "MIT",
            .summary = "Mesh files as models of one body", .readers = readers)
