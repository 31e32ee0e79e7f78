// SPDX-License-Identifier: MIT
#pragma once

#include "muro/object.hpp"

namespace muro {

enum class ShapeKind : std::uint32_t { box, sphere, cylinder, capsule, plane, mesh, heightmap };
/// Source of a shape's look.
enum class MaterialSource : std::uint32_t {
  file,   ///< a mesh has the materials of its file; other shapes have `color`
  model,  ///< `color`, times `texture`
};

/// Material of a shape in contact. See toolkit/pair_surface.hpp for the surface of a pair of shapes.
struct Surface {
  double friction = 0.8;           ///< Coulomb coefficient
  double restitution = 0;          ///< 0..1 (Newton)
  double rolling_resistance = 0;   ///< m: torque against rolling by the normal force (MuJoCo's rolling friction)
  double spinning_resistance = 0;  ///< m: torque against turning about the normal by the normal force (torsional)
};

/// A shape of a body, for collision, rays and rendering, centred on its origin unless `size` says otherwise. May grow
/// at its end: plugins hold it as a constant of a body, as Rows, or behind a pointer.
struct Shape {
  ShapeKind kind = ShapeKind::box;
  TextId mesh = no_text;     ///< mesh, heightmap: path of the file
  TextId texture = no_text;  ///< path of a picture (PNG, JPEG, ...) on its surface
  MaterialSource material_source = MaterialSource::file;
  /// box: full lengths x, y, z. sphere: radius, -, -. cylinder: radius, -, length along z. capsule: radius, -, length
  /// of the straight part along z. plane: unused (normal +z through the origin, solid below). mesh: scale. heightmap:
  /// full lengths in x and y, and the height of its value 1; centred in x and y only, for scenery only, see
  /// toolkit/heightmap.hpp. All in m, the scale in 1.
  Vec3 size = Vec3::Zero();
  Pose origin{};  ///< of the shape in the frame of its body
  Surface surface{};
  Eigen::Vector4d color = Eigen::Vector4d(0.7, 0.7, 0.7, 1);  ///< red, green, blue, alpha, 0..1

  static Shape box(const Vec3& lengths) { return {.kind = ShapeKind::box, .size = lengths}; }
  static Shape sphere(double radius) { return {.kind = ShapeKind::sphere, .size = {radius, 0, 0}}; }
  static Shape cylinder(double radius, double length) {
    return {.kind = ShapeKind::cylinder, .size = {radius, 0, length}};
  }
  static Shape capsule(double radius, double length) {
    return {.kind = ShapeKind::capsule, .size = {radius, 0, length}};
  }
  static Shape plane() { return {.kind = ShapeKind::plane}; }
};
MURO_GROWING_TYPE(Shape, "muro.Shape");

}  // namespace muro
