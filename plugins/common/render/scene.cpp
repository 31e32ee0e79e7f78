// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>
#include <limits>

#include "heightmap_surface.hpp"
#include "muro/algorithm.hpp"
#include "muro/base/bounds.hpp"
#include "plugins/common/heightmap/solid.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::render {

namespace {

double radius_of(const Surface& s) {
  double max = 0;
  for (const Vertex& v : s.vertices) max = std::max(max, Vec3(v.position[0], v.position[1], v.position[2]).norm());
  return max;
}

}  // namespace

bool SolidShape::contains(const Vec3& point) const {
  const Pose& at = body.pose();
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
    case ShapeKind::heightmap:
      return heightmap.columns > 0 && heightmap::contains(heightmap, p);
    case ShapeKind::mesh:
      break;
  }
  return false;
}

void Scene::connect(Connector& c, ShapeSource source, double tolerance) {
  tolerance_ = tolerance;
  const auto shapes_of = [&](ObjectId object) {
    const Rows<Shape> collision = c.constant_array(object, keys::collision_shapes);
    if (source == ShapeSource::collision) return collision;
    const Rows<Shape> visual = c.constant_array(object, keys::visual_shapes);
    return visual.empty() ? collision : visual;
  };
  const auto add_body = [&](const SceneBody& body, Rows<Shape> shapes) {
    Instance instance;
    instance.body = body;
    for (const Shape& s : shapes) {
      SolidShape& solid =
          solid_shapes_.emplace_back(SolidShape{s, body, s.origin.position.norm() + half_extents(s).norm()});
      if (s.kind == ShapeKind::heightmap) {
        solid.radius = std::numeric_limits<double>::infinity();
        if (const auto* file = file_of_heightmap(c, s, body.object)) solid.heightmap = file->heightmap(s.size);
      }
      add_shape(c, s, instance, source);
    }
  };
  scene_bodies::for_each_body(c, shapes_of, add_body);
}

void Scene::add_shape(Connector& c, const Shape& shape, Instance instance, ShapeSource source) {
  instance.origin = shape.origin;
  instance.color = shape.color.head<3>();
  if (shape.kind == ShapeKind::mesh) return add_mesh(c, shape, instance, source);
  const bool has_texture = source == ShapeSource::visual && shape.texture != no_text;
  const std::int32_t texture = has_texture ? texture_of(c, std::string(c.text(shape.texture))) : -1;
  if (shape.kind == ShapeKind::heightmap) return add_heightmap(c, shape, instance, texture);
  const bool is_round = shape.kind != ShapeKind::box && shape.kind != ShapeKind::plane;
  const int corners = is_round ? corners_for(shape.size.x(), tolerance_) : 0;
  const auto add = [&](const char* name, const Vec3& scale, double up = 0, bool upside_down = false) {
    Instance i = instance;
    i.origin.position += i.origin.orientation * Vec3(0, 0, up);
    if (upside_down) i.origin.orientation = i.origin.orientation * Quat(0, 1, 0, 0);
    i.surface = primitive(name, corners, texture);
    i.scale = scale;
    i.radius = radii_[i.surface] * scale.cwiseAbs().maxCoeff();
    instances_.push_back(i);
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
      instance.is_infinite = true;
      add("ground", {1, 1, 1});
      break;
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
}

void Scene::add_mesh(Connector& c, const Shape& shape, Instance instance, ShapeSource source) {
  const std::string path(c.text(shape.mesh));
  const bool file_materials = source == ShapeSource::visual && shape.material_source == MaterialSource::file;
  const bool has_texture = source == ShapeSource::visual && !file_materials && shape.texture != no_text;
  std::string name = path + (file_materials ? " with its materials" : "");
  if (has_texture) name += " " + std::string(c.text(shape.texture));
  const auto [entry, is_new] = meshes_.try_emplace({name, shape.size.x(), shape.size.y(), shape.size.z()});
  if (const auto reason = unreadable_.find(path); reason != unreadable_.end()) {
    report_unreadable(c, shape, instance.body.object, reason->second);
  } else if (is_new) {
    try {
      entry->second = load_mesh(c, shape, path, file_materials, has_texture);
    } catch (const Error& error) {
      report_unreadable(c, shape, instance.body.object, error.what());
    }
  }
  for (const ColoredSurface& part : entry->second) {
    instance.surface = part.surface;
    instance.radius = radii_[part.surface];
    if (file_materials) instance.color = part.color;
    instances_.push_back(instance);
  }
}

void Scene::report_unreadable(Connector& c, const Shape& shape, ObjectId body, const std::string& reason) {
  const std::string path(c.text(shape.mesh));
  const bool is_first = unreadable_.try_emplace(path, reason).second;
  const Rows<Shape> collision = c.constant_array(body, keys::collision_shapes);
  const bool collides = std::any_of(collision.begin(), collision.end(),
                                    [&](const Shape& s) { return s.kind == shape.kind && c.text(s.mesh) == path; });
  if (collides)
    mesh::refuse_collision_mesh(c, body, Error(reason));
  else if (is_first)
    c.host().log(LogLevel::warning, quote(c.object_name(body)) + ": " + reason + "; it is not drawn");
}

const heightmap::HeightmapFile* Scene::file_of_heightmap(Connector& c, const Shape& shape, ObjectId body) {
  try {
    return &heightmap_files_.file(std::string(c.text(shape.mesh)));
  } catch (const Error& error) {
    report_unreadable(c, shape, body, error.what());
    return nullptr;
  }
}

void Scene::add_heightmap(Connector& c, const Shape& shape, Instance instance, std::int32_t texture) {
  const heightmap::HeightmapFile* file = file_of_heightmap(c, shape, instance.body.object);
  if (!file) return;
  const auto [entry, is_new] = heightmaps_.try_emplace(
      {std::string(c.text(shape.mesh)), shape.size.x(), shape.size.y(), shape.size.z(), texture});
  if (is_new)
    for (HeightmapPart& part : parts_of(file->heightmap(shape.size))) {
      part.surface.texture = texture;
      part.surface.repeats = false;
      entry->second.push_back({add(std::move(part.surface)), part.centre});
    }
  for (const SurfacePart& part : entry->second) {
    instance.surface = part.surface;
    instance.origin.position = shape.origin * part.centre;
    instance.radius = radii_[part.surface];
    instances_.push_back(instance);
  }
}

std::vector<Scene::ColoredSurface> Scene::load_mesh(Connector& c, const Shape& shape, const std::string& path,
                                                    bool file_materials, bool has_texture) {
  if (!file_materials && !has_texture) return {{add(surface_of(mesh::load(path, shape.size))), Vec3::Ones()}};
  std::vector<ColoredSurface> surfaces;
  for (const mesh::Submesh& part : mesh::load_submeshes(path, shape.size)) {
    Surface s = surface_of(part);
    if (has_texture)
      s.texture = texture_of(c, std::string(c.text(shape.texture)));
    else if (!part.texture.empty())
      s.texture = texture_of(c, part.texture, part.texture_bytes);
    surfaces.push_back({add(std::move(s)), part.color.head<3>()});
    if (file_materials && !part.missing_texture.empty())
      c.host().log(LogLevel::warning, "mesh " + path + ": its picture `" + part.missing_texture +
                                          "` is not there, or not PNG or JPEG; what it covers is plain");
  }
  return surfaces;
}

std::uint32_t Scene::primitive(const std::string& name, int corners, std::int32_t texture) {
  const auto [entry, is_new] = primitives_.try_emplace({name, corners, texture}, 0);
  if (!is_new) return entry->second;
  Surface surface = name == "box"        ? unit_box()
                    : name == "sphere"   ? unit_sphere(corners)
                    : name == "cylinder" ? unit_cylinder(corners)
                    : name == "tube"     ? unit_tube(corners)
                    : name == "dome"     ? unit_dome(corners)
                                         : unit_ground();
  surface.texture = texture;
  return entry->second = add(std::move(surface));
}

std::uint32_t Scene::add(Surface surface) {
  radii_.push_back(radius_of(surface));
  surfaces_.push_back(std::move(surface));
  return std::uint32_t(surfaces_.size() - 1);
}

std::int32_t Scene::texture_of(Connector& c, const std::string& path, std::span<const std::uint8_t> bytes) {
  const auto [entry, is_new] = texture_numbers_.try_emplace(path, -1);
  if (!is_new) return entry->second;
  try {
    textures_.push_back(bytes.empty() ? Image::from_file(path) : Image::from_bytes(bytes, path));
    entry->second = std::int32_t(textures_.size() - 1);
  } catch (const Error& e) {
    c.host().log(LogLevel::warning, std::string(e.what()) + "; what it covers is plain");
  }
  return entry->second;
}

}  // namespace muro::render
