// SPDX-License-Identifier: MIT
#include "host/scenario/scenario.hpp"

#include <algorithm>
#include <filesystem>

#include "host/scenario/parts.hpp"
#include "host/scenario/robot.hpp"
#include "host/scenario/section.hpp"
#include "host/scenario/yaml.hpp"

namespace muro::host {

namespace {

namespace fs = std::filesystem;

/// One rectangle of a place, with its copies.
void read_rectangle(const Node& n, const std::string& what, std::vector<Rectangle>& out, Problems& problems) {
  Section s(n, what, problems);
  Rectangle r;
  if (const auto c = s.numbers("center", {2})) r.x = (*c)[0], r.y = (*c)[1];
  if (const auto size = s.numbers("size", {2})) {
    r.width = (*size)[0], r.depth = (*size)[1];
    if (r.width <= 0 || r.depth <= 0) s.problem("size", "must be greater than 0");
  }
  r.headings = s.numbers("headings", {}).value_or(std::vector<double>{});
  int columns = 1, rows = 1;
  double dx = 0, dy = 0;
  if (const Node* repeat = s.find("repeat")) {
    const Placement g = read_grid(*repeat, "`repeat` of " + what, problems);
    columns = g.columns, rows = g.rows, dx = g.spacing_x, dy = g.spacing_y;
  }
  s.close();
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      Rectangle copy = r;
      copy.x += (i - 0.5 * (columns - 1)) * dx;
      copy.y += (k - 0.5 * (rows - 1)) * dy;
      out.push_back(copy);
    }
}

SceneryObject read_object(const std::string& name, const Node& node, Problems& problems) {
  Section s(node, "object `" + name + "`", problems);
  SceneryObject object;
  object.name = name;
  object.location = node.location;
  object.counted = s.has("place");
  object.placement = read_placement(s, problems);
  if (object.placement.form == Placement::Form::random)
    s.problem("place", "must be a `list` or a `grid`: random places are for robots");
  const auto shape = read_shape(s, object.mesh, problems);
  if (!shape && node.kind == Node::Kind::map) problems.add(node.location, s.what() + " needs a `shape`");
  object.shape = shape.value_or(Shape{});
  s.close();
  return object;
}

void read_world(const Node& n, Scenario& out, Problems& problems) {
  Section s(n, "`world`", problems);
  if (const Node* file = s.find("file"))
    out.world_file = {file_beside(file->location, s.text("file", "")), file->location};
  if (const auto g = s.numbers("gravity", {3})) out.gravity = Vec3((*g)[0], (*g)[1], (*g)[2]);
  Section places(s.map("places"), "`places`", problems);
  for (const auto& [name, unused] : places.others())
    for (const Node& e : places.list(name).list) read_rectangle(e, "place `" + name + "`", out.places[name], problems);
  const Node& objects = s.map("objects");
  std::vector<std::string> names;
  for (const auto& [name, node] : objects.map)
    if (!node.is_off()) names.push_back(name);
  check_off(objects, names, "`objects`", problems);
  for (std::size_t i = 0; i < objects.map.size(); ++i) {
    const auto& [name, node] = objects.map[i];
    if (!node.is_off() && check_name(name, objects.key_locations[i], "an object", problems))
      out.objects.push_back(read_object(name, node, problems));
  }
  s.close();
}

void read_algorithms(const Node& n, Scenario& out, Problems& problems) {
  std::vector<std::string> names = {"collision", "contact", "index", "kinematics"};
  for (const auto& [name, node] : n.map)
    if (is_subsystem(node)) names.push_back(name);
  check_off(n, names, "`algorithms`", problems);
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
  Section s(n, "`schedule`", problems);
  for (const Node& e : s.list("sequences").list) {
    std::vector<Name> names;
    for (const Node& name : e.list)
      if (name.kind == Node::Kind::scalar) names.push_back({name.scalar, name.location});
    if (names.size() < 2 || names.size() != e.list.size())
      problems.add(e.location,
                   "a sequence is a list of at least two names of algorithms, such as [collision, contact]");
    out.sequences.push_back(std::move(names));
  }
  s.close();
}

unsigned read_threads(const Node& n, Problems& problems) {
  if (n.kind == Node::Kind::scalar && n.scalar == "all") return 0;
  const double count = as_number(n).value_or(0);
  if (count >= 1 && count <= max_threads && count == std::floor(count)) return unsigned(count);
  problems.add(n.location, "`threads` is " + shown(n) + " but must be a number of threads from 1 to " +
                               std::to_string(max_threads) + ", or `all` that the machine has");
  return 1;
}

/// `key:` with nothing behind it is a slip more often than a wish.
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

Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides) {
  Node root = load_yaml(path);
  for (const std::string& o : overrides) apply_override(root, o);
  Scenario out;
  out.file = path;
  Problems problems;
  check_empty(root, problems);
  Section s(root, "the scenario", problems);
  out.name = s.text("name", fs::path(path).stem().string());
  out.seed = std::uint64_t(s.integer("seed", 1, 0, std::int64_t(1) << 53));
  out.duration = s.number("duration", out.duration, 0, 1e9);
  if (const Node* threads = s.find("threads")) out.threads = read_threads(*threads, problems);
  if (const Node* world = s.find("world")) read_world(*world, out, problems);
  out.robots = read_robots(s.map("robots"), problems);
  read_algorithms(s.map("algorithms"), out, problems);
  if (const Node* schedule = s.find("schedule")) read_schedule(*schedule, out, problems);
  s.close();
  problems.check();
  return out;
}

}  // namespace muro::host
