// SPDX-License-Identifier: MIT
#include "host/scenario/parts.hpp"

#include <algorithm>
#include <filesystem>

#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_in_a_row = 10'000, most_copies = 1'000'000;

Placement::At read_at(const Node& n, const std::string& what, Problems& problems) {
  Section s(n, what, problems);
  Placement::At at;
  at.x = s.number("x", 0);
  at.y = s.number("y", 0);
  if (s.has("z")) at.z = s.number("z", 0);
  at.roll = s.number("roll", 0);
  at.pitch = s.number("pitch", 0);
  at.yaw = s.number("yaw", 0);
  s.close();
  return at;
}

Shape read_form(Section& f, const std::string& form, std::string& mesh, Problems& problems) {
  const auto sized = [&](std::size_t length) {
    auto v = f.numbers(form, {length});
    const bool fine = v && std::none_of(v->begin(), v->end(), [](double x) { return x <= 0; });
    if (v && !fine) f.problem(form, "must be greater than 0");
    return fine ? *v : std::vector<double>(length, 1);
  };
  if (form == "sphere") return Shape::sphere(f.number(form, 1, 1e-6, 1e6));
  if (form == "mesh") {
    Shape shape;
    shape.kind = ShapeKind::mesh;
    shape.size = f.vector("scale", Vec3::Ones());
    const Location& at = f.find(form)->location;
    mesh = file_beside(at, f.text(form, ""));
    std::error_code code;
    if (!fs::is_regular_file(mesh, code)) problems.add(at, "mesh file " + mesh + " does not exist");
    return shape;
  }
  const std::vector<double> v = sized(form == "box" ? 3 : 2);
  if (form == "box") return Shape::box({v[0], v[1], v[2]});
  return form == "cylinder" ? Shape::cylinder(v[0], v[1]) : Shape::capsule(v[0], v[1]);
}

}  // namespace

std::string file_beside(const Location& at, const std::string& name) {
  const fs::path file(name);
  if (file.is_absolute() || !at.in_file()) return file.lexically_normal().string();
  return (fs::path(at.file).parent_path() / file).lexically_normal().string();
}

Placement read_grid(const Node& n, const std::string& what, Problems& problems) {
  Section s(n, what, problems);
  Placement p;
  p.form = Placement::Form::grid;
  if (!s.has("count")) problems.add(n.location, what + " needs `count: [along x, along y]`");
  if (const auto counts = s.numbers("count", {2})) {
    const bool fine = std::all_of(counts->begin(), counts->end(),
                                  [](double c) { return c == std::floor(c) && c >= 1 && c <= double(most_in_a_row); });
    if (!fine || (*counts)[0] * (*counts)[1] > double(most_copies)) {
      s.problem("count", "must be two whole numbers, along x and along y, from 1 to " + std::to_string(most_in_a_row) +
                             " each and of at most " + std::to_string(most_copies) + " places in all");
    } else {
      p.columns = int((*counts)[0]);
      p.rows = int((*counts)[1]);
    }
  }
  if (const auto spacing = s.numbers("spacing", {2})) {
    p.spacing_x = (*spacing)[0];
    p.spacing_y = (*spacing)[1];
  }
  const Node* centre = s.find("center");
  p.list.push_back(centre ? read_at(*centre, "`center` of " + what, problems) : Placement::At{});
  s.close();
  return p;
}

Placement read_placement(Section& s, Problems& problems) {
  const std::string& what = s.what();
  Placement p;
  const Node* at = s.find("at");
  const Node* place = s.find("place");
  if (at && place) s.problem("place", "and `at` exclude each other: one says where, so drop the other");
  if (at || !place) {
    p.list.push_back(at ? read_at(*at, "`at` of " + what, problems) : Placement::At{});
    p.location = at ? at->location : s.location();
    return p;
  }
  Section form(*place, "`place` of " + what, problems);
  const std::optional<std::string> kind = form.one_of({"list", "grid", "random"});
  if (kind == "list") {
    const Node& list = form.list("list");
    if (list.list.empty()) form.problem("list", "must be a list of {x, y, yaw, ...}");
    for (const Node& e : list.list) p.list.push_back(read_at(e, "an entry of `list` of " + what, problems));
  } else if (kind == "grid") {
    p = read_grid(*form.find("grid"), "`grid` of " + what, problems);
  } else if (kind == "random") {
    p.form = Placement::Form::random;
    p.area = form.text("random", "");
    if (form.has("seed")) p.seed = std::uint64_t(form.integer("seed", 1, 0, std::int64_t(1) << 53));
    p.clearance = form.number("clearance", 0.1, 0, 1e6);
  }
  if (p.list.empty()) p.list.emplace_back();
  if (kind) form.close();
  p.location = place->location;
  return p;
}

std::optional<Shape> read_shape(Section& s, std::string& mesh, Problems& problems) {
  const std::string& what = s.what();
  const Node* n = s.find("shape");
  if (!n) {
    for (const char* key : {"friction", "restitution", "color"})
      if (s.has(key)) s.problem(key, "goes with `shape`, which is missing; a model says it itself");
    return std::nullopt;
  }
  Shape shape;
  if (n->kind == Node::Kind::scalar && n->scalar == "plane") {
    shape = Shape::plane();
  } else if (n->kind != Node::Kind::map) {
    s.problem("shape",
              "is " + shown(*n) +
                  " but must be `plane` or one of: {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, "
                  "{capsule: [radius, length]}, {mesh: file}");
  } else {
    Section f(*n, "`shape` of " + what, problems);
    if (const auto form = f.one_of({"box", "sphere", "cylinder", "capsule", "mesh"})) {
      shape = read_form(f, *form, mesh, problems);
      f.close();
    }
  }
  shape.friction = s.number("friction", shape.friction, 0, 100);
  shape.restitution = s.number("restitution", shape.restitution, 0, 1);
  if (const auto c = s.numbers("color", {3, 4})) {
    shape.color = {(*c)[0], (*c)[1], (*c)[2], c->size() == 4 ? (*c)[3] : 1.0};
    shape.material_source = MaterialSource::model;
  }
  return shape;
}

void check_off(const Node& map, const std::vector<std::string>& names, const std::string& what, Problems& problems) {
  for (std::size_t i = 0; i < map.map.size(); ++i) {
    const auto& [key, value] = map.map[i];
    if (!value.is_off() || value.replaces || value.empty) continue;
    if (std::find(names.begin(), names.end(), key) != names.end()) continue;
    problems.add(map.key_locations[i], "nothing is named `" + key + "` in " + what + ", so it cannot be switched off" +
                                           did_you_mean(key, names) +
                                           (names.empty() ? "" : "; there are: " + listed(names)));
  }
}

}  // namespace muro::host
