// SPDX-License-Identifier: MIT
// The ground on which robots and scenery are placed, where a scene has heightmaps.
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

/// The heightmaps of the scenery, and its planes, over each other: the highest is the ground.
class Terrain {
 public:
  explicit Terrain(ShapeFiles& files) : files_(files) {}

  /// Throws SetupError when the file of a heightmap cannot be read.
  void check_file(const Shape& heightmap, const std::string& file) { files_.heightmaps.of(file, heightmap.size); }
  /// Adds a shape of the scenery that stands at `pose`; what is neither heightmap nor plane, or does not look up, is no
  /// ground.
  void add(const Shape& shape, const std::string& file, const Pose& pose);
  /// The same for all scenery of a world so far.
  void add_scenery(const World& world);
  bool has_heightmaps() const { return !tiles_.empty(); }

  /// The height (m) of the origin of what is placed at `at`, whose own height does not count, so that nothing of its
  /// shapes (of meshes: their convex hulls) is below the ground and one touches it. Nothing where there is no ground
  /// under it. Throws SetupError when a file cannot be read.
  std::optional<double> height(std::span<const StandingShape> shapes, const Pose& at);

 private:
  struct Tile {
    std::string file;
    Vec3 size;
    Pose pose;
  };

  std::array<double, 2> heights_of(const Tile& tile);
  Aabb part_near(const Tile& tile, const ConvexBottom& bottom);
  std::optional<double> rise(const Tile& tile, const StandingShape& shape, const Pose& at);

  ShapeFiles& files_;
  std::vector<Tile> tiles_;
  std::vector<Pose> planes_;
  std::map<std::string, std::array<double, 2>> heights_;  ///< lowest and highest value, by file
};

}  // namespace muro::host
