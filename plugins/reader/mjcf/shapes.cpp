// SPDX-License-Identifier: MIT
#include "shapes.hpp"

#include <algorithm>
#include <cstdio>

#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

/// Colour that MuJoCo gives geoms with neither a colour nor a material.
constexpr float plain_grey[] = {0.5f, 0.5f, 0.5f, 1};
/// First group that MuJoCo's viewer does not show.
constexpr int first_hidden_group = 3;

}  // namespace

Shapes::Shapes(const Compiled& compiled, const Source& source)
    : m_(*compiled.model), source_(source), meshes_(compiled, source), height_fields_(compiled, source) {}

std::string Shapes::name_of_geom(int number) const {
  const std::string name = name_of(m_, m_.name_geomadr, number);
  if (!name.empty()) return name;
  const int body = m_.geom_bodyid[number];
  const std::string owner = name_of(m_, m_.name_bodyadr, body);
  return concat("geom ", number - m_.body_geomadr[body] + 1, " of ",
                body == 0       ? "worldbody"
                : owner.empty() ? concat("body ", body)
                                : owner);
}

Surface Shapes::surface_of(int number) const {
  const mjtNum* const friction = m_.geom_friction + 3 * number;
  const int dimensions = m_.geom_condim[number];
  Surface surface;
  surface.friction = dimensions >= 3 ? friction[0] : 0;
  surface.restitution = 0;
  surface.spinning_resistance = dimensions >= 4 ? friction[1] : 0;
  surface.rolling_resistance = dimensions >= 6 ? friction[2] : 0;
  return surface;
}

std::optional<Shape> Shapes::heights_of(int number, const Intern& intern, std::string& problem) {
  const std::optional<PlacedHeights> heights = height_fields_.of(number, problem);
  if (!heights) return std::nullopt;
  if (heights->error > 1e-6 * heights->size.head<2>().maxCoeff()) rounded_[number] = heights->error;
  if (heights->path.empty()) return Shape{.kind = ShapeKind::box, .size = heights->size, .origin = heights->pose};
  return Shape{
      .kind = ShapeKind::heightmap, .mesh = intern(heights->path), .size = heights->size, .origin = heights->pose};
}

std::optional<Shape> Shapes::shape_of(int number, const Intern& intern, std::string& problem) {
  const mjtNum* const size = m_.geom_size + 3 * number;
  switch (m_.geom_type[number]) {
    case mjGEOM_PLANE:
      return Shape::plane();
    case mjGEOM_SPHERE:
      return Shape::sphere(size[0]);
    case mjGEOM_CAPSULE:
      return Shape::capsule(size[0], 2 * size[1]);
    case mjGEOM_CYLINDER:
      return Shape::cylinder(size[0], 2 * size[1]);
    case mjGEOM_BOX:
      return Shape::box(2 * vector_of(size));
    case mjGEOM_MESH: {
      const std::optional<PlacedMesh> mesh = meshes_.of(number, problem);
      if (!mesh) return std::nullopt;
      return Shape{.kind = ShapeKind::mesh, .mesh = intern(mesh->path), .size = mesh->scale, .origin = mesh->pose};
    }
    case mjGEOM_ELLIPSOID:
      problem = "there is no shape `ellipsoid`; take a sphere, a capsule or a mesh";
      return std::nullopt;
    case mjGEOM_HFIELD:
      return heights_of(number, intern, problem);
    default:
      problem = "there is no such shape";
      return std::nullopt;
  }
}

void Shapes::add(int number, const Pose& body, const Intern& intern, Solid& solid) {
  std::string problem;
  std::optional<Shape> shape = shape_of(number, intern, problem);
  if (!shape) {
    const auto known =
        std::find_if(left_out_.begin(), left_out_.end(), [&](const auto& entry) { return entry.first == problem; });
    (known == left_out_.end() ? left_out_.emplace_back(problem, std::vector<int>{}) : *known).second.push_back(number);
    return;
  }
  const bool is_mesh = shape->kind == ShapeKind::mesh;  // the pose is already that of the file
  const Pose geom = is_mesh ? Pose{} : pose_of(m_.geom_pos + 3 * number, m_.geom_quat + 4 * number);
  shape->origin = body * geom * shape->origin;
  shape->surface = surface_of(number);
  const float* color = m_.geom_rgba + 4 * number;
  const int material = m_.geom_matid[number];
  if (material >= 0 && std::equal(color, color + 4, plain_grey)) color = m_.mat_rgba + 4 * material;
  for (int k = 0; k < 4; ++k) shape->color[k] = std::clamp(double(color[k]), 0.0, 1.0);
  shape->material_source = MaterialSource::model;
  if (is_to_touch(number)) solid.collisions.push_back(*shape);
  if (m_.geom_group[number] >= first_hidden_group || shape->color[3] <= 0) return;
  solid.visuals.push_back(*shape);
  solid.materials.push_back(material < 0 ? no_text : intern(name_of(m_, m_.name_matadr, material)));
}

bool Shapes::is_to_touch(int geom) const { return m_.geom_contype[geom] != 0 || m_.geom_conaffinity[geom] != 0; }

void Shapes::report_left_out(Problems& problems) const {
  for (const auto& [geom, error] : rounded_) {
    char metres[32];
    std::snprintf(metres, sizeof metres, "%.2g", error);
    problems.note(source_.location_of("geom", name_of(m_, m_.name_geomadr, geom)),
                  concat("the heights of geom ", quote(name_of_geom(geom)), " differ by up to ", metres,
                         " m from MuJoCo's, which reads 8 bits of a picture"));
  }
  for (const auto& [why, geoms] : left_out_) {
    std::vector<std::string> names;
    for (const int g : geoms) names.push_back(name_of_geom(g));
    const Location at = source_.location_of("geom", name_of(m_, m_.name_geomadr, geoms.front()));
    const bool any_to_touch = std::any_of(geoms.begin(), geoms.end(), [&](int g) { return is_to_touch(g); });
    problems.report(any_to_touch ? Severity::lost_collision : Severity::warning, at,
                    concat(geoms.size() == 1 ? "geom " : "geoms ", quoted_list(names),
                           geoms.size() == 1 ? " is left out: " : " are left out: ", why));
  }
}

}  // namespace muro::mjcf
