// SPDX-License-Identifier: MIT
#include "bodies.hpp"

#include <algorithm>

#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "plugins/common/model_file/inertia.hpp"

namespace muro::urdf {

namespace {

std::string owner_of(const ::urdf::Link& link) { return "link " + quote(link.name); }

}  // namespace

void Bodies::fill(const ::urdf::Link& link, const LinkInfo& info) {
  std::vector<Shape> collisions, visuals;
  std::vector<TextId> materials;
  for (std::size_t i = 0; i < link.collision_array.size(); ++i) {
    const ::urdf::Collision& c = *link.collision_array[i];
    if (c.geometry) add_shape(collisions, Purpose::collision, *c.geometry, c.origin, info.collisions.at(i), info);
  }
  for (std::size_t i = 0; i < link.visual_array.size(); ++i) {
    const auto& v = link.visual_array[i];
    if (!v->geometry) continue;
    const std::size_t before = visuals.size();
    add_shape(visuals, Purpose::visual, *v->geometry, v->origin, info.visuals.at(i), info);
    if (visuals.size() == before) continue;
    const std::string& material = info.visuals.at(i).material;
    materials.push_back(material.empty() ? no_text : builder_.intern(material));
    if (!v->material) continue;
    const ::urdf::Color& c = v->material->color;
    visuals.back().color = Eigen::Vector4f(c.r, c.g, c.b, c.a).cast<double>();
    visuals.back().material_source = MaterialSource::model;
    add_texture(visuals.back(), v->material->texture_filename, link, info);
  }
  if (link.inertial) {
    const Inertia inertia = inertial_of(link, info, collisions.empty() ? visuals : collisions);
    mass_ += inertia.mass;
    builder_.set(keys::inertial, inertia);
  }
  if (!collisions.empty()) builder_.set_array<Shape>(keys::collision_shapes, collisions);
  if (!visuals.empty()) builder_.set_array<Shape>(keys::visual_shapes, visuals);
  if (std::any_of(materials.begin(), materials.end(), [](TextId m) { return m != no_text; }))
    builder_.set_array<TextId>(keys::visual_materials, materials);
}

void Bodies::add_shape(std::vector<Shape>& shapes, Purpose purpose, const ::urdf::Geometry& geometry,
                       const ::urdf::Pose& origin, const LinkInfo::ShapeInfo& place, const LinkInfo& link) {
  Shape shape;
  switch (geometry.type) {
    case ::urdf::Geometry::BOX: {
      const auto& box = static_cast<const ::urdf::Box&>(geometry);
      shape = Shape::box({box.dim.x, box.dim.y, box.dim.z});
      break;
    }
    case ::urdf::Geometry::SPHERE:
      shape = Shape::sphere(static_cast<const ::urdf::Sphere&>(geometry).radius);
      break;
    case ::urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const ::urdf::Cylinder&>(geometry);
      shape = place.is_capsule ? Shape::capsule(cylinder.radius, cylinder.length)
                               : Shape::cylinder(cylinder.radius, cylinder.length);
      break;
    }
    case ::urdf::Geometry::MESH:
      if (!add_mesh(shape, purpose, static_cast<const ::urdf::Mesh&>(geometry), place.location)) return;
      break;
  }
  shape.origin = pose_of(origin, place.rotation);
  shape.surface.friction = link.surface.friction.value_or(shape.surface.friction);
  shape.surface.restitution = link.surface.restitution.value_or(shape.surface.restitution);
  shape.surface.rolling_resistance = link.surface.rolling_resistance.value_or(0);
  shape.surface.spinning_resistance = link.surface.spinning_resistance.value_or(0);
  shapes.push_back(shape);
}

void Bodies::add_texture(Shape& shape, const std::string& name, const ::urdf::Link& link, const LinkInfo& info) {
  if (name.empty()) return;
  const model_file::MeshPath found = model_file::find_file(name, places_.folder, places_.packages);
  if (found.path.empty())
    problems_.warning(info.location, concat(owner_of(link), ": texture ", quote(name), " is not found; it is plain"));
  else
    shape.texture = builder_.intern(found.path);
}

bool Bodies::add_mesh(Shape& shape, Purpose purpose, const ::urdf::Mesh& mesh, const Location& location) {
  const auto [entry, fresh] = meshes_.try_emplace(mesh.filename);
  model_file::MeshPath& found = entry->second;
  if (fresh) {
    found = model_file::find_mesh(mesh.filename, places_.folder, places_.packages);
    if (const std::string note = model_file::note_on(mesh.filename, found); !note.empty())
      problems_.note(location, note);
  }
  if (found.path.empty()) {
    missing_.add(mesh.filename, location, found, purpose == Purpose::collision);
    return false;
  }
  shape = {
      .kind = ShapeKind::mesh, .mesh = builder_.intern(found.path), .size = {mesh.scale.x, mesh.scale.y, mesh.scale.z}};
  return true;
}

Inertia Bodies::inertial_of(const ::urdf::Link& link, const LinkInfo& info, std::span<const Shape> shapes) {
  const ::urdf::Inertial& i = *link.inertial;
  const Inertia given{
      .mass = i.mass, .ixx = i.ixx, .iyy = i.iyy, .izz = i.izz, .ixy = i.ixy, .ixz = i.ixz, .iyz = i.iyz};
  return model_file::checked_inertia(given, pose_of(i.origin, info.inertial_rotation), shapes, owner_of(link),
                                     info.location, problems_);
}

}  // namespace muro::urdf
