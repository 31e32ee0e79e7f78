// SPDX-License-Identifier: MIT
// The ground on which robots and scenery are placed.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "core/world.hpp"
#include "host/scenario/convex_bottom.hpp"
#include "host/scenario/shape_files.hpp"

namespace muro::host {

/// A shape of a body that is placed.
struct StandingShape {
  Shape shape;
  std::string mesh;  ///< path of a mesh's file
  Pose pose{};       ///< in the frame of the body
};

/// Returns the collision shapes of a robot. `positions`: position of the joint of each link (rad or m).
std::vector<StandingShape> standing_shapes(const RobotTree& tree, std::span<const double> positions);

/// Returns the first link of a robot that has a heightmap as a collision shape; empty: none.
std::string link_with_heightmap(const RobotTree& tree);

/// The ground under robots and scenery: the heightmaps, planes and floors of the scenery, which may be over each other;
/// the highest counts. A floor is a box at least ten times as wide as it is thick, within 45 deg of level. Where there
/// is nothing below, the plane z = 0 is the ground.
class Terrain {
 public:
  explicit Terrain(ShapeFiles& files) : files_(files) {}

  /// Throws SetupError when the file of a heightmap cannot be read.
  void check_file(const Shape& heightmap, const std::string& file) { files_.heightmaps.of(file, heightmap.size); }
  /// Whether bodies without a given height can stand on a shape, if it faces upwards.
  static bool carries(const Shape& shape);
  /// Adds a shape of the scenery at `pose`; a shape that does not face upwards, or carries nothing, is no ground.
  void add(const Shape& shape, const std::string& file, const Pose& pose);
  /// Adds all scenery that a world has so far.
  void add_scenery(const World& world);

  /// Returns the height (m) of a body's origin at `at`, whose own height does not count. The body stands so that all of
  /// its shapes are above the ground and one touches it; over heightmaps and floors, meshes are their convex hulls. A
  /// body without shapes has its origin on the ground. Floors above it are no ground. Throws SetupError when a file
  /// cannot be read.
  double height(std::span<const StandingShape> shapes, const Pose& at);
  bool has_heightmaps() const { return !tiles_.empty(); }
  /// Returns the height over heightmaps and planes only; nothing when there is none below.
  std::optional<double> height_on_terrain(std::span<const StandingShape> shapes, const Pose& at);

 private:
  struct Tile {
    std::string file;
    Vec3 size;
    Pose pose;
  };
  struct Floor {
    Pose pose;
    Vec3 half;         ///< m, half lengths
    double low, high;  ///< m, of the box around it in the world
  };

  double extent_along(std::span<const StandingShape> shapes, const Quat& orientation, const Vec3& direction);
  std::array<double, 2> heights_of(const Tile& tile);
  Aabb part_near(const Tile& tile, const ConvexBottom& bottom);
  void add_triangles(const Tile& tile, RiseAbove& above);
  std::optional<double> height_on_floor(const Floor& floor, std::span<const StandingShape> shapes, const Pose& at);
  template <class AddTriangles>
  std::optional<double> rise(std::span<const StandingShape> shapes, const Pose& at, AddTriangles add_triangles);

  ShapeFiles& files_;
  std::vector<Tile> tiles_;
  std::vector<Pose> planes_;
  std::vector<Floor> floors_;                             ///< by height
  std::map<std::string, std::array<double, 2>> heights_;  ///< lowest and highest value, by file
};

}  // namespace muro::host
