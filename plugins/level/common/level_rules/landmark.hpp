// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/shape.hpp"

namespace muro::level {

/// The goal of the distances that a rule measures: robots, an object of the scenery or a place. Distances from a point
/// in the world, m:
///
/// - robots: to the nearest of their bases;
/// - scenery: to the nearest point of its collision shapes, or of its visual shapes if it has no others; 0 inside. A
///   mesh or a heightmap counts as its bounding box, in the axes of its file;
/// - a place: to the nearest of its rectangles, in the ground plane; 0 inside.
class Landmark {
 public:
  Landmark() = default;
  /// Finds `name` in a rule of `robot`; empty: all other robots but shadows. Throws Error, with the nearest names, if
  /// nothing has this name, or if a place and something else have it. `rule`: for messages. [setup]
  Landmark(Connector& c, const RobotView& robot, const std::string& name, std::string_view rule);
  /// Returns the place of this name. Throws Error if there is none. [setup]
  static Landmark place(const Connector& c, const std::string& name, std::string_view rule);

  /// Returns infinity if the landmark is empty.
  double distance(const Vec3& from) const;

 private:
  /// A shape of scenery, as its kind defines it; for other kinds the box of `half` lengths about its origin.
  struct Solid {
    ShapeKind kind;
    Vec3 size, half;
    Pose to_shape;  ///< from the world to the shape
  };
  struct Rectangle {
    double x, y, half_width, half_depth;
  };

  void add_scenery(const Connector& c, ObjectId object, std::string_view rule);
  void add_place(const Connector& c, std::string_view name);
  static double distance(const Solid& solid, const Vec3& from);

  std::vector<In<Pose>> robots_;
  std::vector<Solid> solids_;
  std::vector<Rectangle> rectangles_;
};

}  // namespace muro::level
