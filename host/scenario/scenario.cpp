// SPDX-License-Identifier: MIT
#include "host/scenario/scenario.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "core/error.hpp"
#include "muro/nearest.hpp"
#include "host/scenario/section.hpp"

namespace muro::host {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const Location& at) {
  const fs::path folder = fs::path(at.file).parent_path();
  return at.line > 0 ? folder.string() : "";
}

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

Placement read_grid(const Node& n, const std::string& what, Problems& problems) {
  Section s(n, what, problems);
  Placement p;
  p.form = Placement::Form::grid;
  if (const auto counts = s.numbers("count", {2})) {
    p.columns = int((*counts)[0]);
    p.rows = int((*counts)[1]);
    if (p.columns < 1 || p.rows < 1) s.problem("count", "must be two numbers of at least 1: along x, along y");
  } else if (!n.find("count")) {
    problems.add(n.location, what + " needs `count: [along x, along y]`");
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

/// `at: {x, y, ...}`, or `place:` with one of `list`, `grid`, `random`.
Placement read_placement(Section& s, const std::string& what, Problems& problems) {
  Placement p;
  const Node* at = s.find("at");
  const Node* place = s.find("place");
  if (at && place) s.problem("place", "and `at` exclude each other: one says where, so drop the other");
  if (at) {
    p.list.push_back(read_at(*at, "`at` of " + what, problems));
    p.location = at->location;
    return p;
  }
  if (!place) {
    p.list.emplace_back();
    p.location = s.location();
    return p;
  }
  Section form(*place, "`place` of " + what, problems);
  if (const Node* list = form.find("list")) {
    if (list->kind != Node::Kind::list || list->list.empty()) form.problem("list", "must be a list of {x, y, yaw, ...}");
    for (const Node& e : list->list) p.list.push_back(read_at(e, "an entry of `list` of " + what, problems));
    if (p.list.empty()) p.list.emplace_back();
  } else if (const Node* grid = form.find("grid")) {
    p = read_grid(*grid, "`grid` of " + what, problems);
  } else if (form.has("random")) {
    p.form = Placement::Form::random;
    p.area = form.text("random", "");
    p.seed = std::uint64_t(form.integer("seed", 1, 0, std::int64_t(1) << 53));
    p.clearance = form.number("clearance", 0.1, 0, 1e6);
    p.list.emplace_back();
  } else {
    problems.add(place->location, "`place` of " + what + " needs one of: list, grid, random");
    p.list.emplace_back();
  }
  form.close();
  p.location = place->location;
  return p;
}

/// `shape: plane`, or {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, {capsule: [...]}, {mesh: file}.
std::optional<Shape> read_shape(Section& s, const std::string& what, std::string* mesh, Problems& problems) {
  const Node* n = s.find("shape");
  if (!n) return std::nullopt;
  Shape shape;
  if (n->kind == Node::Kind::scalar && n->scalar == "plane") {
    shape = Shape::plane();
  } else {
    Section f(*n, "`shape` of " + what, problems);
    const auto sized = [&](const char* key, std::size_t length) {
      const auto v = f.numbers(key, {length});
      if (v && std::any_of(v->begin(), v->end(), [](double x) { return x <= 0; })) f.problem(key, "must be greater than 0");
      return v;
    };
    if (f.has("box")) {
      if (const auto v = sized("box", 3)) shape = Shape::box({(*v)[0], (*v)[1], (*v)[2]});
    } else if (f.has("sphere")) {
      shape = Shape::sphere(f.number("sphere", 1, 1e-6, 1e6));
    } else if (f.has("cylinder")) {
      if (const auto v = sized("cylinder", 2)) shape = Shape::cylinder((*v)[0], (*v)[1]);
    } else if (f.has("capsule")) {
      if (const auto v = sized("capsule", 2)) shape = Shape::capsule((*v)[0], (*v)[1]);
    } else if (f.has("mesh")) {
      shape.kind = ShapeKind::mesh;
      shape.size = f.vector("scale", Vec3::Ones());
      if (mesh) *mesh = (fs::path(folder_of(n->location)) / f.text("mesh", "")).string();
    } else {
      problems.add(n->location, "`shape` of " + what +
                                    " must be `plane` or one of: {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, "
                                    "{capsule: [radius, length]}, {mesh: file}");
    }
    f.close();
  }
  shape.friction = s.number("friction", shape.friction, 0, 100);
  shape.restitution = s.number("restitution", shape.restitution, 0, 1);
  if (const auto c = s.numbers("color", {3, 4}))
    shape.color = {(*c)[0], (*c)[1], (*c)[2], c->size() == 4 ? (*c)[3] : 1.0};
  return shape;
}

bool is_subsystem(const Node& n) { return n.kind == Node::Kind::map && n.find("use") != nullptr; }

std::optional<Subsystem> read_subsystem(const std::string& name, const Node& n, const std::string& owner, Problems& problems) {
  if (n.is_off()) return std::nullopt;
  const std::string what = "`" + name + "` of " + owner;
  Section s(n, what, problems);
  Subsystem sub;
  sub.name = name;
  sub.location = n.location;
  sub.use = s.text("use", "");
  const Node* rate = s.find("rate");
  if (rate && rate->kind == Node::Kind::scalar && rate->scalar == "on_demand")
    sub.on_demand = true;
  else if (rate)
    sub.rate = s.number("rate", 1, 1e-6, 1e9);
  sub.phase = s.number("phase", 0, 0, 1e9);
  sub.on = s.text("on", "");
  const auto take = [&](const std::string& key, const Node& value) {
    if (const auto p = as_parameter(value))
      sub.parameters[key] = *p;
    else
      problems.add(value.location, "parameter `" + key + "` of " + what + " must be a single value or a flat list");
  };
  // parameters under the name of an algorithm count only for that algorithm
  for (const auto& [key, value] : s.others()) {
    if (key.find('.') == std::string::npos)
      take(key, *value);
    else if (key == sub.use)
      for (const auto& [inner, v] : value->map) take(inner, v);
  }
  return sub;
}

void read_world(const Node& n, Scenario& out, Problems& problems) {
  Section s(n, "`world`", problems);
  out.gravity = s.vector("gravity", out.gravity);
  if (const Node* places = s.find("places"))
    for (const auto& [name, list] : places->map)
      for (const Node& e : list.list) {
        Section r(e, "place `" + name + "`", problems);
        Rectangle base;
        if (const auto c = r.numbers("center", {2})) base.x = (*c)[0], base.y = (*c)[1];
        if (const auto size = r.numbers("size", {2})) base.width = (*size)[0], base.depth = (*size)[1];
        if (const Node* h = r.find("headings"))
          for (const Node& v : h->list) base.headings.push_back(as_number(v).value_or(0));
        int columns = 1, rows = 1;
        double dx = 0, dy = 0;
        if (const Node* repeat = r.find("repeat")) {
          const Placement g = read_grid(*repeat, "`repeat` of place `" + name + "`", problems);
          columns = g.columns, rows = g.rows, dx = g.spacing_x, dy = g.spacing_y;
        }
        r.close();
        for (int i = 0; i < columns; ++i)
          for (int k = 0; k < rows; ++k) {
            Rectangle copy = base;
            copy.x += (i - 0.5 * (columns - 1)) * dx;
            copy.y += (k - 0.5 * (rows - 1)) * dy;
            out.places[name].push_back(copy);
          }
      }
  if (const Node* objects = s.find("objects"))
    for (const auto& [name, node] : objects->map) {
      if (node.is_off()) continue;
      const std::string what = "object `" + name + "`";
      Section o(node, what, problems);
      SceneryObject object;
      object.name = name;
      object.counted = node.find("place") != nullptr;
      object.placement = read_placement(o, what, problems);
      const auto shape = read_shape(o, what, &object.mesh, problems);
      if (!shape) problems.add(node.location, what + " needs a `shape`");
      object.shape = shape.value_or(Shape{});
      o.close();
      out.objects.push_back(std::move(object));
    }
  s.close();
}

/// Applies `variants: {"0-4": {...}}` of a template to robot `i`.
Node variant_of(const Node& robot, int i, int count, Problems& problems) {
  Node merged = robot;
  const Node* variants = robot.find("variants");
  if (!variants) return merged;
  for (std::size_t v = 0; v < variants->map.size(); ++v) {
    const auto& [range, changes] = variants->map[v];
    int first = 0, last = 0;
    const char* end = range.data() + range.size();
    auto [p, code] = std::from_chars(range.data(), end, first);
    last = first;
    if (code == std::errc{} && p != end && *p == '-') std::tie(p, code) = [&] {
      const auto r = std::from_chars(p + 1, end, last);
      return std::pair(r.ptr, r.ec);
    }();
    if (code != std::errc{} || p != end || first < 0 || last < first || last >= count) {
      problems.add(variants->key_locations[v], "variant `" + range + "` must be a number or a range such as 0-4, within 0-" +
                                                   std::to_string(count - 1));
      continue;
    }
    if (i < first || i > last) continue;
    for (const auto& [key, change] : changes.map) {
      if (change.kind == Node::Kind::map && merged.find(key) && merged.find(key)->kind == Node::Kind::map) {
        Node& target = *merged.find(key);
        for (const auto& [inner, value] : change.map) target.child(inner, value.location) = value;
        target.location = change.location;
      } else {
        merged.child(key, change.location) = change;
      }
    }
  }
  return merged;
}

void read_robot(const std::string& name, const Node& node, Scenario& out, Problems& problems) {
  const std::string what = "robot `" + name + "`";
  Section s(node, what, problems);
  RobotTemplate t;
  t.name = name;
  t.location = node.location;
  if (const Node* model = s.find("model")) {
    const fs::path given = s.text("model", "");
    t.model = (given.is_absolute() ? given : fs::path(folder_of(model->location)) / given).lexically_normal().string();
  }
  t.shape = read_shape(s, what, nullptr, problems);
  t.mass = s.number("mass", 0, 1e-9, 1e9);
  if (t.model.empty() == !t.shape) problems.add(node.location, what + " needs either a `model` or a `shape` with a `mass`");
  if (t.shape && t.mass <= 0) problems.add(node.location, what + " needs a `mass` in kg");
  t.counted = node.find("count") != nullptr;
  t.count = int(s.integer("count", 1, 0, 1'000'000));
  t.placement = read_placement(s, what, problems);
  if (!t.counted && t.placement.form != Placement::Form::random) {
    const Placement& p = t.placement;
    const std::size_t copies = p.form == Placement::Form::grid ? std::size_t(p.columns * p.rows) : p.list.size();
    t.counted = copies > 1;
    t.count = int(copies);
  }
  t.linear_velocity = s.vector("velocity", Vec3::Zero());
  t.angular_velocity = s.vector("angular_velocity", Vec3::Zero());
  if (const Node* joints = s.find("joints"))
    for (const auto& [joint, value] : joints->map) {
      const auto x = as_number(value);
      if (!x) problems.add(value.location, "joint `" + joint + "` of " + what + " must have a number as its position");
      t.joints[joint] = x.value_or(0);
    }
  s.find("variants");
  // Whatever is left must be a subsystem.
  for (const auto& [key, value] : s.others())
    if (!is_subsystem(*value) && !value->is_off()) {
      const bool map = value->kind == Node::Kind::map;
      if (map)
        problems.add(value->location, "subsystem `" + key + "` of " + what + " needs `use: NAME`; `muro plugins list` shows the names");
      else
        problems.add(s.key_location(key),
                     what + " has no key `" + key + "`" +
                         did_you_mean(key, std::vector<std::string>{"model", "shape", "mass", "count", "place", "at", "velocity",
                                                                  "angular_velocity", "joints", "variants"}) +
                         "; allowed: model, shape, mass, friction, restitution, color, count, place, at, velocity, angular_velocity, "
                         "joints, variants, and subsystems {use: NAME, ...}");
    }
  for (int i = 0; i < t.count; ++i) {
    const Node robot = variant_of(node, i, t.count, problems);
    std::vector<Subsystem> subsystems;
    for (const auto& [key, value] : robot.map)
      if (is_subsystem(value))
        if (auto sub = read_subsystem(key, value, what, problems)) subsystems.push_back(std::move(*sub));
    t.subsystems.push_back(std::move(subsystems));
  }
  out.robots.push_back(std::move(t));
}

void read_schedule(const Node& n, Scenario& out, Problems& problems) {
  Section s(n, "`schedule`", problems);
  if (const Node* sequences = s.find("sequences"))
    for (const Node& e : sequences->list) {
      std::vector<std::string> names;
      for (const Node& name : e.list) names.push_back(name.scalar);
      if (names.size() < 2) problems.add(e.location, "a sequence is a list of at least two algorithms, such as [collision, contact]");
      out.sequences.push_back(std::move(names));
      out.sequence_locations.push_back(e.location);
    }
  s.close();
}

}  // namespace

Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides) {
  Node root = load_yaml(path);
  for (const std::string& o : overrides) apply_override(root, o);
  Scenario out;
  out.file = path;
  Problems problems;
  Section s(root, "the scenario", problems);
  out.name = s.text("name", fs::path(path).stem().string());
  out.seed = std::uint64_t(s.integer("seed", 1, 0, std::int64_t(1) << 53));
  out.duration = s.number("duration", out.duration, 0, 1e9);
  if (const Node* world = s.find("world")) read_world(*world, out, problems);
  if (const Node* robots = s.find("robots")) {
    if (robots->kind != Node::Kind::map) s.problem("robots", "must be a map of robot names");
    for (const auto& [name, node] : robots->map)
      if (!node.is_off()) read_robot(name, node, out, problems);
  }
  if (const Node* algorithms = s.find("algorithms"))
    for (const auto& [name, node] : algorithms->map) {
      if (node.is_off())
        out.switched_off.push_back(name);
      else if (!is_subsystem(node))
        problems.add(node.location, "algorithm `" + name + "` needs `use: NAME`; `muro plugins list` shows the names");
      else if (auto sub = read_subsystem(name, node, "`algorithms`", problems))
        out.algorithms.push_back(std::move(*sub));
    }
  if (const Node* schedule = s.find("schedule")) read_schedule(*schedule, out, problems);
  s.close();
  problems.check();
  return out;
}

}  // namespace muro::host
