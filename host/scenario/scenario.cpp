// SPDX-License-Identifier: MIT
#include "host/scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "host/scenario/map_reader.hpp"
#include "host/scenario/placement_reader.hpp"
#include "host/scenario/robot_reader.hpp"
#include "host/scenario/shape_reader.hpp"
#include "host/scenario/subsystem_reader.hpp"
#include "host/scenario/yaml.hpp"
#include "muro/base/limits.hpp"

namespace muro::host {

namespace {

namespace fs = std::filesystem;

/// Reads one rectangle of a place, with its copies.
void read_rectangle(const Node& n, const std::string& what, std::vector<Rectangle>& out, Problems& problems) {
  MapReader map(n, what, problems);
  Rectangle r;
  if (const auto c = map.numbers("center", {2}, -limits::position, limits::position)) r.x = (*c)[0], r.y = (*c)[1];
  if (const auto size = map.numbers("size", {2}, limits::min_size, limits::position))
    r.width = (*size)[0], r.depth = (*size)[1];
  r.headings = map.numbers("headings", {}, -limits::angle, limits::angle).value_or(std::vector<double>{});
  int columns = 1, rows = 1;
  double dx = 0, dy = 0;
  if (const Node* repeat = map.find("repeat")) {
    const Placement grid = read_grid(*repeat, "`repeat` of " + what, problems);
    columns = grid.columns, rows = grid.rows, dx = grid.spacing_x, dy = grid.spacing_y;
  }
  map.reject_unknown_keys();
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      Rectangle copy = r;
      copy.x += (i - 0.5 * (columns - 1)) * dx;
      copy.y += (k - 0.5 * (rows - 1)) * dy;
      out.push_back(copy);
    }
}

SceneryObject read_object(const std::string& name, const Node& node, Problems& problems) {
  MapReader map(node, "object `" + name + "`", problems);
  SceneryObject object;
  object.name = name;
  object.location = node.location;
  object.numbered = map.has("place");
  object.placement = read_placement(map, problems);
  if (object.placement.kind == Placement::Kind::random)
    map.problem("place", "must be a `list` or a `grid`: random places are for robots");
  const auto shape = read_shape(map, object.mesh, object.texture, problems);
  if (!shape && node.kind == Node::Kind::map) problems.add(node.location, map.what() + " needs a `shape`");
  object.shape = shape.value_or(Shape{});
  map.reject_unknown_keys();
  return object;
}

FrictionRule read_friction_rule(const Node& n, Problems& problems) {
  MapReader map(n, "`friction` of `world`", problems);
  const std::string word = map.text("combine", "min");
  map.reject_unknown_keys();
  constexpr std::pair<std::string_view, FrictionRule> rules[] = {{"min", FrictionRule::min},
                                                                 {"mean", FrictionRule::mean},
                                                                 {"product", FrictionRule::product},
                                                                 {"max", FrictionRule::max}};
  for (const auto& [known, rule] : rules)
    if (known == word) return rule;
  map.problem("combine", fmt::format("is `{}` but must be one of: min, mean, product, max", word));
  return FrictionRule::min;
}

void read_world(const Node& n, Scenario& out, Problems& problems) {
  MapReader map(n, "`world`", problems);
  if (const Node* file = map.find("file"))
    out.world_file = {resolve_path(file->location, map.text("file", "")), file->location};
  if (map.has("gravity")) out.gravity = map.vector("gravity", {0, 0, -9.81}, limits::gravity);
  if (map.has("friction")) out.friction_rule = read_friction_rule(map.map("friction"), problems);
  MapReader places(map.map("places"), "`places`", problems);
  for (const auto& [name, unused] : places.unread())
    for (const Node& e : places.list(name).list) read_rectangle(e, "place `" + name + "`", out.places[name], problems);
  const Node& objects = map.map("objects");
  std::vector<std::string> names;
  for (const auto& [name, node] : objects.map)
    if (!node.is_off()) names.push_back(name);
  check_switched_off(objects, names, "`objects`", problems);
  for (std::size_t i = 0; i < objects.map.size(); ++i) {
    const auto& [name, node] = objects.map[i];
    if (!node.is_off() && check_name(name, objects.key_locations[i], "an object", problems))
      out.objects.push_back(read_object(name, node, problems));
  }
  map.reject_unknown_keys();
}

void read_algorithms(const Node& n, Scenario& out, Problems& problems) {
  std::vector<std::string> names = {"collision", "contact", "index", "kinematics"};
  for (const auto& [name, node] : n.map)
    if (is_subsystem(node)) names.push_back(name);
  check_switched_off(n, names, "`algorithms`", problems);
  for (std::size_t i = 0; i < n.map.size(); ++i) {
    const auto& [name, node] = n.map[i];
    if (node.is_off())
      out.switched_off.push_back(name);
    else if (!is_subsystem(node))
      problems.add(n.key_locations[i],
                   "algorithm `" + name + "` needs `use: NAME`; `muro plugins list` shows the names");
    else if (check_name(name, n.key_locations[i], "an algorithm", problems))
      out.algorithms.push_back(read_subsystem(name, node, "`algorithms`", problems));
  }
}

void read_schedule(const Node& n, Scenario& out, Problems& problems) {
  MapReader map(n, "`schedule`", problems);
  for (const Node& e : map.list("sequences").list) {
    std::vector<Name> names;
    for (const Node& name : e.list)
      if (name.kind == Node::Kind::scalar) names.push_back({name.scalar, name.location});
    if (names.size() < 2 || names.size() != e.list.size())
      problems.add(e.location,
                   "a sequence is a list of at least two names of algorithms, such as [collision, contact]");
    out.sequences.push_back(std::move(names));
  }
  map.reject_unknown_keys();
}

void read_plugins(const Node& n, Scenario& out, Problems& problems) {
  for (const auto& [name, library] : n.map) {
    if (library.kind == Node::Kind::scalar && !library.scalar.empty())
      out.plugins[name] = {resolve_path(library.location, library.scalar), library.location.text()};
    else
      problems.add(library.location,
                   "`plugins`: `" + name + "` must be the path of the library that is to offer it: NAME.so");
  }
}

void read_packages(const Node& n, Scenario& out, Problems& problems) {
  for (const auto& [name, folder] : n.map) {
    if (folder.is_off()) continue;
    if (name.empty() || name.find('/') != name.npos) {
      problems.add(folder.location,
                   fmt::format("`packages`: `{}` is no name of a package, which is not empty and has no "
                               "`/`: that of package://NAME/... and model://NAME/...",
                               name));
      continue;
    }
    if (folder.kind != Node::Kind::scalar || folder.scalar.empty()) {
      problems.add(folder.location, "`packages`: `" + name + "` must be the folder of the package of that name");
      continue;
    }
    const fs::path path = fs::absolute(resolve_path(folder.location, folder.scalar)).lexically_normal();
    std::error_code error;
    if (fs::is_directory(path, error))
      out.packages[name] = path.string();
    else
      problems.add(folder.location,
                   fmt::format("`packages`: `{}` is {}, which is no folder; give the one that holds the meshes/ and "
                               "models that package://{}/... names",
                               name, path.string(), name));
  }
}

unsigned read_threads(const Node& n, Problems& problems) {
  if (n.kind == Node::Kind::scalar && n.scalar == "all") return 0;
  const double count = as_number(n).value_or(0);
  if (count >= 1 && count <= max_threads && count == std::floor(count)) return unsigned(count);
  problems.add(n.location,
               fmt::format("`threads` is {} but must be a number of threads from 1 to {}, or `all` that the "
                           "machine has",
                           quoted(n), max_threads));
  return 1;
}

/// Reports keys without a value: they are mistakes more often than intended.
void check_empty(const Node& n, Problems& problems) {
  for (std::size_t i = 0; i < n.map.size(); ++i) {
    const auto& [key, value] = n.map[i];
    if (value.empty)
      problems.add(value.location,
                   "`" + key + "` has no value; leave the key out, or write `off` to switch a part off");
    check_empty(value, problems);
  }
  for (const Node& e : n.list) check_empty(e, problems);
}

}  // namespace

std::string instance_name(const std::string& name, bool numbered, std::size_t index) {
  return numbered ? fmt::format("{}_{}", name, index) : name;
}

Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides,
                       const std::function<void(Node& root)>& complete) {
  Scenario out;
  Node root = load_yaml(path, &out.files);
  if (complete) complete(root);
  for (const std::string& o : overrides) apply_override(root, o);
  out.file = path;
  Problems problems;
  check_empty(root, problems);
  MapReader map(root, "the scenario", problems);
  out.name = map.text("name", fs::path(path).stem().string());
  out.seed = std::uint64_t(map.integer("seed", 1, 0, std::int64_t(1) << 53));
  out.duration = map.number("duration", out.duration, 0, 1e9);
  if (const Node* threads = map.find("threads")) out.threads = read_threads(*threads, problems);
  read_plugins(map.map("plugins"), out, problems);
  read_packages(map.map("packages"), out, problems);
  if (const Node* world = map.find("world")) read_world(*world, out, problems);
  out.robots = read_robots(map.map("robots"), problems);
  read_algorithms(map.map("algorithms"), out, problems);
  if (const Node* schedule = map.find("schedule")) read_schedule(*schedule, out, problems);
  map.reject_unknown_keys();
  problems.check();
  return out;
}

}  // namespace muro::host
