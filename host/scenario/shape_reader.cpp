// SPDX-License-Identifier: MIT
#include "host/scenario/shape_reader.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/missing_file.hpp"
#include "muro/base/limits.hpp"

namespace muro::host {

namespace {

namespace fs = std::filesystem;

/// Reads a heightmap; `file` gets its path, which starts at the folder of the scenario.
Shape read_heightmap(MapReader& map, std::string& file, Problems& problems) {
  Shape shape{.kind = ShapeKind::heightmap, .size = Vec3::Ones()};
  file = file_of(map, "heightmap", problems);
  if (!map.has("size"))
    map.problem("heightmap", "needs `size: [x, y, z]`: its full lengths in x and y, and the height of white, m");
  else if (const auto size = map.numbers("size", {3}, limits::min_size, limits::max_size))
    shape.size = {(*size)[0], (*size)[1], (*size)[2]};
  return shape;
}

Shape read_mesh(MapReader& map, std::string& mesh, Problems& problems) {
  Shape shape;
  shape.kind = ShapeKind::mesh;
  shape.size = map.vector("scale", Vec3::Ones(), limits::max_size);
  if (shape.size.cwiseAbs().minCoeff() < limits::min_size) {
    map.problem("scale", "has a factor that is nearer to 0 than 1e-9");
    shape.size = Vec3::Ones();
  }
  mesh = file_of(map, "mesh", problems);
  return shape;
}

/// Reads a geometry. `kind`: the key that names it, such as "box".
Shape read_geometry(MapReader& map, const std::string& kind, std::string& mesh, Problems& problems) {
  if (kind == "sphere") return Shape::sphere(map.number(kind, 1, limits::min_size, limits::max_size));
  if (kind == "mesh") return read_mesh(map, mesh, problems);
  if (kind == "heightmap") return read_heightmap(map, mesh, problems);
  const std::size_t length = kind == "box" ? 3 : 2;
  const auto given = map.numbers(kind, {length}, limits::min_size, limits::max_size);
  const std::vector<double> v = given ? *given : std::vector<double>(length, 1);
  if (kind == "box") return Shape::box({v[0], v[1], v[2]});
  return kind == "cylinder" ? Shape::cylinder(v[0], v[1]) : Shape::capsule(v[0], v[1]);
}

}  // namespace

std::string resolve_path(const Location& at, const std::string& name) {
  const fs::path file(name);
  if (file.is_absolute() || !at.in_file()) return file.lexically_normal().string();
  return (fs::path(at.file).parent_path() / file).lexically_normal().string();
}

std::string file_of(MapReader& map, const std::string& key, Problems& problems) {
  const Node& value = *map.find(key);
  std::string path = resolve_path(value.location, map.text(key, ""));
  if (value.kind != Node::Kind::scalar) return path;  // reported already
  std::error_code code;
  const char* const problem = value.scalar.empty()               ? "has no name"
                              : fs::is_directory(path, code)     ? "is a folder"
                              : !fs::is_regular_file(path, code) ? "does not exist"
                                                                 : nullptr;
  if (problem)
    problems.add(value.location, key + " file " + (value.scalar.empty() ? "" : path + " ") + problem +
                                     (value.scalar.empty() || fs::exists(path, code) ? "" : nearest_file(path)) +
                                     "; correct its path, which starts at the folder of this file");
  return path;
}

std::optional<Eigen::Vector4d> read_color(MapReader& map) {
  const auto c = map.numbers("color", {3, 4}, 0, 1);
  if (!c) return std::nullopt;
  return Eigen::Vector4d((*c)[0], (*c)[1], (*c)[2], c->size() == 4 ? (*c)[3] : 1.0);
}

std::optional<Shape> read_shape(MapReader& map, std::string& mesh, std::string& texture, Problems& problems) {
  const Node* n = map.find("shape");
  if (!n) {
    for (const char* key : {"friction", "restitution", "rolling_resistance", "spinning_resistance", "color", "texture"})
      if (map.has(key)) map.problem(key, "belongs to a `shape`, which is missing; a model states it itself");
    return std::nullopt;
  }
  Shape shape;
  if (n->kind == Node::Kind::scalar && n->scalar == "plane") {
    shape = Shape::plane();
  } else if (n->kind != Node::Kind::map) {
    map.problem(
        "shape",
        fmt::format(
            "is {} but must be `plane` or one of: {{box: [x, y, z]}}, {{sphere: radius}}, {{cylinder: "
            "[radius, length]}}, {{capsule: [radius, length]}}, {{mesh: file}}, {{heightmap: file, size: [x, y, z]}}",
            quoted(*n)));
  } else {
    MapReader geometry(*n, "`shape` of " + map.what(), problems);
    if (const auto kind = geometry.one_of({"box", "sphere", "cylinder", "capsule", "mesh", "heightmap"})) {
      shape = read_geometry(geometry, *kind, mesh, problems);
      geometry.reject_unknown_keys();
    }
  }
  shape.surface.friction = map.number("friction", shape.surface.friction, 0, 100);
  shape.surface.restitution = map.number("restitution", shape.surface.restitution, 0, 1);
  for (const auto& [key, resistance] : {std::pair{"rolling_resistance", &shape.surface.rolling_resistance},
                                        std::pair{"spinning_resistance", &shape.surface.spinning_resistance}})
    *resistance = map.number(key, *resistance, 0, limits::max_size);
  if (map.has("texture")) {
    texture = file_of(map, "texture", problems);
    shape.color = {1, 1, 1, 1};
    shape.material_source = MaterialSource::model;
  }
  if (const auto color = read_color(map)) {
    shape.color = *color;
    shape.material_source = MaterialSource::model;
  }
  return shape;
}

}  // namespace muro::host
