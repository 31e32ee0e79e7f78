// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
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

bool Volume::holds(const Vec3& point) const {
  const Pose& at = body ? *body : place;
  if ((point - at.position).squaredNorm() > radius * radius) return false;
  const Vec3 p = (at * shape.origin).inverse() * point;
  const double r = shape.size.x(), half = 0.5 * shape.size.z();
  switch (shape.kind) {
    case ShapeKind::box:
      return (p.cwiseAbs() - 0.5 * shape.size).maxCoeff() <= 0;
    case ShapeKind::sphere:
      return p.squaredNorm() <= r * r;
    case ShapeKind::cylinder:
      return p.head<2>().squaredNorm() <= r * r && std::abs(p.z()) <= half;
    case ShapeKind::capsule:
      return (p - Vec3(0, 0, std::clamp(p.z(), -half, half))).squaredNorm() <= r * r;
    case ShapeKind::plane:
      return p.z() <= 0;
    case ShapeKind::mesh:
      break;
  }
  return false;
}

void Scene::connect(Connector& c, Look look, double chord) {
  chord_ = chord;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) >= 0) continue;
    Piece piece;
    piece.place = c.constant(object, keys::pose).value_or(Pose{});
    add_body(c, object, piece, look);
  }
  for (const RobotView* robot : c.robots()) {
    if (c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Link& f : robot->links) {
      Piece piece;
      piece.robot = std::int32_t(robot->number);
      add_body(c, f.object, piece, look);
    }
  }
}

void Scene::add_body(Connector& c, ObjectId object, const Piece& of_body, Look look) {
  std::span<const Shape> found = c.constant_array(object, keys::collision_shapes);
  if (look == Look::as_seen)
    if (const auto visual = c.constant_array(object, keys::visual_shapes); !visual.empty()) found = visual;
  if (found.empty()) return;
  const std::vector<Shape> shapes(found.begin(), found.end());
  Piece piece = of_body;
  piece.object = object;
  if (piece.robot >= 0) piece.body = c.read(object, keys::pose);
  for (const Shape& s : shapes) {
    volumes_.push_back(
        {s, piece.body, piece.place, object, piece.robot, s.origin.position.norm() + half_extents(s).norm()});
    add_shape(c, s, piece, look);
  }
}

void Scene::add_shape(Connector& c, const Shape& shape, Piece piece, Look look) {
  piece.origin = shape.origin;
  piece.color = shape.color.head<3>();
  if (shape.kind == ShapeKind::mesh) return add_mesh(c, shape, piece, look);
  const bool covered = look == Look::as_seen && shape.texture != no_text;
  const std::int32_t picture = covered ? picture_of(c, std::string(c.text(shape.texture))) : -1;
  const bool round = shape.kind != ShapeKind::box && shape.kind != ShapeKind::plane;
  const int corners = round ? corners_for(shape.size.x(), chord_) : 0;
  const auto add = [&](const char* name, const Vec3& scale, double up = 0, bool turned = false) {
    Piece p = piece;
    p.origin.position += p.origin.orientation * Vec3(0, 0, up);
    if (turned) p.origin.orientation = p.origin.orientation * Quat(0, 1, 0, 0);
    p.surface = basic(name, corners, picture);
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
      break;
  }
}

void Scene::add_mesh(Connector& c, const Shape& shape, Piece piece, Look look) {
  const std::string path(c.text(shape.mesh));
  const bool by_file = look == Look::as_seen && shape.material_source == MaterialSource::file;
  const bool covered = look == Look::as_seen && !by_file && shape.texture != no_text;
  std::string name = path + (by_file ? " painted" : "");
  if (covered) name += " " + std::string(c.text(shape.texture));
  const auto [known, fresh] = meshes_.try_emplace({name, shape.size.x(), shape.size.y(), shape.size.z()});
  if (fresh && (by_file || covered)) {
    for (const mesh::PaintedPart& part : mesh::load_painted(path, shape.size)) {
      Surface s = surface_of(part);
      if (covered)
        s.picture = picture_of(c, std::string(c.text(shape.texture)));
      else if (!part.picture.empty())
        s.picture = picture_of(c, part.picture, part.picture_bytes);
      known->second.push_back({keep(std::move(s)), part.color.head<3>()});
      if (by_file && !part.missing.empty())
        c.host().log(LogLevel::warning, "mesh " + path + ": its picture `" + part.missing +
                                            "` is not there, or not PNG or JPEG; what it covers is plain");
    }
  } else if (fresh) {
    known->second.push_back({keep(surface_of(mesh::load(path, shape.size))), Vec3::Ones()});
  }
  for (const Part& part : known->second) {
    piece.surface = part.surface;
    piece.radius = radii_[part.surface];
    if (by_file) piece.color = part.color;
    pieces_.push_back(piece);
  }
}

std::uint32_t Scene::basic(const std::string& name, int corners, std::int32_t picture) {
  const auto [known, fresh] = basics_.try_emplace({name, corners, picture}, 0);
  if (!fresh) return known->second;
  Surface made = name == "box"        ? unit_box()
                 : name == "sphere"   ? unit_sphere(corners)
                 : name == "cylinder" ? unit_cylinder(corners)
                 : name == "tube"     ? unit_tube(corners)
                 : name == "dome"     ? unit_dome(corners)
                                      : unit_ground();
  made.picture = picture;
  return known->second = keep(std::move(made));
}

std::uint32_t Scene::keep(Surface surface) {
  radii_.push_back(radius_of(surface));
  surfaces_.push_back(std::move(surface));
  return std::uint32_t(surfaces_.size() - 1);
}

std::int32_t Scene::picture_of(Connector& c, const std::string& path, std::span<const std::uint8_t> bytes) {
  const auto [known, fresh] = picture_numbers_.try_emplace(path, -1);
  if (!fresh) return known->second;
  try {
    pictures_.push_back(bytes.empty() ? Image::from_file(path) : Image::from_bytes(bytes, path));
    known->second = std::int32_t(pictures_.size() - 1);
  } catch (const Error& e) {
    c.host().log(LogLevel::warning, std::string(e.what()) + "; what it covers is plain");
  }
  return known->second;
}

}  // namespace muro::render
