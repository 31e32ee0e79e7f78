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

/// A shape of what is placed.
struct StandingShape {
  Shape shape;
  std::string mesh;  ///< path of a mesh's file
  Pose pose{};       ///< in the frame of what is placed
};

/// The collision shapes of a robot. `positions`: of the joint of each link (rad or m).
std::vector<StandingShape> standing_shapes(const RobotTree& tree, std::span<const double> positions);

/// The first link of a robot that has a heightmap as a collision shape; empty: none.
std::string link_with_heightmap(const RobotTree& tree);

/// What robots and scenery stand on: the heightmaps, planes and floors of the scenery, over each other; the highest
/// counts. A floor is a box at least ten times as wide as it is thick that lies within 45 deg of level. Where there is
/// nothing below, the plane z = 0 is the ground.
class Terrain {
 public:
  explicit Terrain(ShapeFiles& files) : files_(files) {}

  /// Throws SetupError when the file of a heightmap cannot be read.
  void check_file(const Shape& heightmap, const std::string& file) { files_.heightmaps.of(file, heightmap.size); }
  /// Whether a shape carries what stands without a height if it looks up.
  static bool carries(const Shape& shape);
  /// Adds a shape of the scenery that stands at `pose`; what does not look up, or carries nothing, is no ground.
  void add(const Shape& shape, const std::string& file, const Pose& pose);
  /// The same for all scenery of a world so far.
  void add_scenery(const World& world);

  /// The height (m) of the origin of what is placed at `at`, whose own height does not count, so that nothing of its
  /// shapes (over heightmaps and floors, of meshes: their convex hulls) is below the ground and one touches it. What
  /// has no shapes stands with its origin on the ground. Floors above it are no ground. Throws SetupError when a file
  /// cannot be read.
  double height(std::span<const StandingShape> shapes, const Pose& at);
  bool has_heightmaps() const { return !tiles_.empty(); }
  /// The same over heightmaps and planes alone; nothing where there is none under it.
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
