// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

#include "muro/vocabulary.hpp"

namespace muro::render {

namespace {

double radius_of(const Surface& s) {
  double most = 0;
  for (const Vertex& v : s.vertices)
    most = std::max(most, double(std::hypot(v.position[0], v.position[1], v.position[2])));
  return most;
}

}  // namespace

void Scene::connect(Connector& c, Look look, int corners) {
  corners_ = corners;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) >= 0) continue;
    Piece piece;
    piece.place = c.constant(object, keys::pose).value_or(Pose{});
    add_body(c, object, piece, look);
  }
  for (const RobotView* robot : c.robots()) {
    if (c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Frame& f : robot->frames) {
      Piece piece;
      piece.robot = std::int32_t(robot->number);
      add_body(c, f.object, piece, look);
    }
  }
}

void Scene::add_body(Connector& c, ObjectId object, const Piece& of_body, Look look) {
  std::span<const Shape> shapes = c.constant_array(object, keys::collision_shapes);
  if (look == Look::as_seen)
    if (const auto visual = c.constant_array(object, keys::visual_shapes); !visual.empty()) shapes = visual;
  if (shapes.empty()) return;
  Piece piece = of_body;
  piece.object = object;
  if (piece.robot >= 0) piece.body = c.read(object, keys::pose);
  for (const Shape& s : shapes) add_shape(c, s, piece);
}

void Scene::add_shape(const Connector& c, const Shape& shape, Piece piece) {
  piece.origin = shape.origin;
  piece.color = shape.color.head<3>();
  const auto add = [&](const char* name, const Vec3& scale, double up = 0, bool turned = false) {
    Piece p = piece;
    p.origin.position += p.origin.orientation * Vec3(0, 0, up);
    if (turned) p.origin.orientation = p.origin.orientation * Quat(0, 1, 0, 0);
    p.surface = surface(name, Vec3::Ones());
    p.scale = scale;
    p.radius = radii_[p.surface] * scale.cwiseAbs().maxCoeff();
    pieces_.push_back(p);
  };
  const double r = shape.size.x(), length = shape.size.z();
  switch (shape.kind) {
    case ShapeKind::box:
      add("box", shape.size);
      break;
    case ShapeKind::sphere:
      add("sphere", {r, r, r});
      break;
    case ShapeKind::cylinder:
      add("cylinder", {r, r, length});
      break;
    case ShapeKind::capsule:
      add("tube", {r, r, length});
      add("dome", {r, r, r}, 0.5 * length);
      add("dome", {r, r, r}, -0.5 * length, true);
      break;
    case ShapeKind::plane:
      piece.endless = true;
      add("ground", {1, 1, 1});
      break;
    case ShapeKind::mesh:
      piece.surface = surface("mesh " + std::string(c.text(shape.mesh)), shape.size);
      piece.radius = radii_[piece.surface];
      pieces_.push_back(piece);
      break;
  }
}

std::uint32_t Scene::surface(const std::string& name, const Vec3& scale) {
  std::string full = name;
  for (int k = 0; k < 3; ++k) full += " " + std::to_string(scale[k]);
  const auto known = std::find(names_.begin(), names_.end(), full);
  if (known != names_.end()) return std::uint32_t(known - names_.begin());
  const auto made = [&]() -> Surface {
    if (name == "box") return unit_box();
    if (name == "sphere") return unit_sphere(corners_);
    if (name == "cylinder") return unit_cylinder(corners_);
    if (name == "tube") return unit_tube(corners_);
    if (name == "dome") return unit_dome(corners_);
    if (name == "ground") return unit_ground();
    return surface_of(mesh::load(name.substr(5), scale));
  };
  surfaces_.push_back(made());
  radii_.push_back(radius_of(surfaces_.back()));
  names_.push_back(full);
  return std::uint32_t(surfaces_.size() - 1);
}

}  // namespace muro::render
