// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/shape.hpp"

namespace muro::level {

/// What a rule measures distances to: robots, an object of the scenery or a place. From a point in the world, m:
///
/// - robots: to the nearest of their bases;
/// - scenery: to the nearest point of its shapes, those for collision if it has some; 0 inside. A mesh or a
///   heightmap counts as the box around it, in the axes of its file;
/// - a place: to the nearest of its rectangles, in the ground plane; 0 inside.
class Landmark {
 public:
  Landmark() = default;
  /// What `name` means in a rule of `robot`; empty: all other robots but shadows. Throws Error with the nearest names
  /// where nothing has it, or a place and something else have it. `rule`: for messages. [setup]
  Landmark(Connector& c, const RobotView& robot, const std::string& name, std::string_view rule);
  /// The place of this name. Throws Error where there is none. [setup]
  static Landmark place(const Connector& c, const std::string& name, std::string_view rule);

  /// Infinite where it is nothing.
  double distance(const Vec3& from) const;

 private:
  /// A shape of scenery; the box of `half` lengths about its origin, or what the kind says.
  struct Solid {
    ShapeKind kind;
    Vec3 size, half;
    Pose to_shape;  ///< from the world
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
