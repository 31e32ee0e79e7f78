// SPDX-License-Identifier: MIT
// The drawn parts of the world: surfaces, their textures, and their instances on bodies.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "image.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/render/scene_bodies.hpp"
#include "surface.hpp"

namespace muro::render {

using scene_bodies::SceneBody;

/// Choice of the shapes of a body that are drawn.
enum class ShapeSource {
  visual,     ///< for cameras: `visual.shapes`, or `collision.shapes` of a body without these
  collision,  ///< for range sensors: `collision.shapes`, without materials
};

/// A surface on a body.
struct Instance {
  std::uint32_t surface = 0;  ///< number in Scene::surfaces
  Pose origin;                ///< in the frame of the body
  Vec3 scale = Vec3::Ones();  ///< of the surface, along its axes; m
  Vec3 color = Vec3::Ones();  ///< 0..1
  SceneBody body;
  double radius = 0;         ///< m, of a bounding sphere about the origin
  bool is_infinite = false;  ///< a plane: drawn up to the range of sight

  Pose pose() const { return body.pose() * origin; }
};

/// A solid shape on a body, used to decide whether a sensor is inside it.
struct SolidShape {
  Shape shape;
  SceneBody body;
  double radius = 0;      ///< m, of a bounding sphere about the origin of the body; infinite for a plane or a heightmap
  Heightmap heightmap{};  ///< only of a heightmap

  /// Whether it contains a point of the world (m). A mesh contains none, a heightmap those below its surface.
  bool contains(const Vec3& point) const;
};

class Scene {
 public:
  /// Finds all shapes and binds the poses of their bodies. Circles become polygons that lie at most `tolerance` (m)
  /// inside them. Textures, visual meshes and heightmaps that cannot be read are omitted with a warning. One that is
  /// also a collision shape is refused: see mesh::refuse_collision_mesh. [setup]
  void connect(Connector& c, ShapeSource source, double tolerance);

  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::vector<Image>& textures() const { return textures_; }
  const std::vector<Instance>& instances() const { return instances_; }
  const std::vector<SolidShape>& solid_shapes() const { return solid_shapes_; }

 private:
  struct ColoredSurface {
    std::uint32_t surface = 0;
    Vec3 color = Vec3::Ones();
  };

  void add_shape(Connector& c, const Shape& shape, Instance instance, ShapeSource source);
  void add_mesh(Connector& c, const Shape& shape, Instance instance, ShapeSource source);
  void add_heightmap(Connector& c, const Shape& shape, Instance instance, std::int32_t texture);
  /// Returns the content of the file of a heightmap; null if it cannot be read, which has then been reported.
  const heightmap::HeightmapFile* file_of_heightmap(Connector& c, const Shape& shape, ObjectId body);
  /// Refuses a file that a body collides with. Warns once about other files, which are then not drawn.
  void report_unreadable(Connector& c, const Shape& shape, ObjectId body, const std::string& reason);
  std::vector<ColoredSurface> load_mesh(Connector& c, const Shape& shape, const std::string& path, bool file_materials,
                                        bool has_texture);
  /// Returns the surface of a primitive whose circles have so many corners, with a texture (-1: none).
  std::uint32_t primitive(const std::string& name, int corners, std::int32_t texture);
  std::uint32_t add(Surface surface);
  std::int32_t texture_of(Connector& c, const std::string& path, std::span<const std::uint8_t> bytes = {});

  double tolerance_ = 0;
  std::map<std::tuple<std::string, int, std::int32_t>, std::uint32_t> primitives_;
  /// Surfaces by file and source of the material, and scale.
  std::map<std::tuple<std::string, double, double, double>, std::vector<ColoredSurface>> meshes_;
  struct SurfacePart {
    std::uint32_t surface = 0;
    Vec3 centre = Vec3::Zero();
  };
  heightmap::Store heightmap_files_;
  /// Surfaces by file, size and texture.
  std::map<std::tuple<std::string, double, double, double, std::int32_t>, std::vector<SurfacePart>> heightmaps_;
  std::map<std::string, std::string> unreadable_;  ///< files of meshes and heightmaps, and why
  std::map<std::string, std::int32_t> texture_numbers_;
  std::vector<double> radii_;  ///< of the surfaces
  std::vector<Surface> surfaces_;
  std::vector<Image> textures_;
  std::vector<Instance> instances_;
  std::vector<SolidShape> solid_shapes_;
};

}  // namespace muro::render
