// SPDX-License-Identifier: MIT
#include "host/scenario/robot_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>
#include <utility>

#include "host/names.hpp"
#include "host/scenario/joint_dynamics.hpp"
#include "host/scenario/levels.hpp"
#include "host/scenario/map_reader.hpp"
#include "host/scenario/materials.hpp"
#include "host/scenario/placement_reader.hpp"
#include "host/scenario/shape_reader.hpp"
#include "host/scenario/subsystem_reader.hpp"
#include "host/scenario/variants.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/limits.hpp"

namespace muro::host {

namespace {

class RobotReader {
 public:
  RobotReader(const Node& robots, Problems& problems) : robots_(robots), problems_(problems) {
    for (const auto& [name, robot] : robots.map) {
      if (!robot.is_off()) robot_names_.push_back(name);
      collect_subsystem_names(robot);
      if (const Node* variants = robot.find("variants"))
        for (const auto& [range, changes] : variants->map) collect_subsystem_names(changes);
    }
  }

  std::vector<RobotTemplate> read() {
    check_switched_off(robots_, robot_names_, "`robots`", problems_);
    std::vector<RobotTemplate> all;
    for (std::size_t i = 0; i < robots_.map.size(); ++i) {
      const auto& [name, robot] = robots_.map[i];
      if (robot.is_off() || !check_name(name, robots_.key_locations[i], "a robot", problems_)) continue;
      all.push_back(read_template(name, robot));
    }
    return all;
  }

 private:
  void collect_subsystem_names(const Node& robot) {
    for (const auto& [key, value] : robot.map)
      if ((is_subsystem(value) || (value.is_off() && value.replaces)) && known_subsystem_names_.insert(key).second)
        subsystem_names_.push_back(key);
  }

  RobotTemplate read_template(const std::string& name, const Node& node) {
    MapReader map(node, "robot `" + name + "`", problems_);
    RobotTemplate t;
    t.name = name;
    t.location = node.location;
    read_body(map, node, t);
    read_copies(map, node, t);
    t.linear_velocity = map.vector("velocity", Vec3::Zero(), limits::speed);
    t.angular_velocity = map.vector("angular_velocity", Vec3::Zero(), limits::turn_rate);
    read_joint_positions(map, t);
    t.dynamics = read_joint_dynamics(map, problems_);
    t.materials = read_materials(map.map("materials"), map.what(), problems_);
    const Node& variants = map.map("variants");
    if (node.kind == Node::Kind::map) {
      const std::vector<Variant> read = read_variants(
          variants, map, t.count, subsystem_names_, [&](UnknownSubsystem u) { take_unknown(std::move(u), t); },
          problems_);
      read_material_variants(read, map.what(), t);
      read_subsystems(map, read, t);
    }
    return t;
  }

  /// Whether there is a model file, which may contain subsystems.
  static bool has_model(const RobotTemplate& t) { return t.from_world || !t.model.empty(); }

  /// Keeps a mistake that may be none: the model may have the subsystem, which is known when the model is read.
  void take_unknown(UnknownSubsystem u, RobotTemplate& t) {
    if (has_model(t))
      t.unknown.push_back(std::move(u));
    else
      problems_.add(u.location, u.problem);
  }

  void read_material_variants(const std::vector<Variant>& variants, const std::string& what, RobotTemplate& t) {
    for (const Variant& v : variants) {
      if (v.changes->kind != Node::Kind::map || !v.changes->find("materials")) continue;
      const std::string whose = fmt::format("variant `{}-{}` of {}", v.first, v.last, what);
      MapReader changes(*v.changes, whose, problems_);
      t.material_variants.push_back({v.first, v.last, read_materials(changes.map("materials"), whose, problems_)});
    }
  }

  /// Reads the number of robots, and their places.
  void read_copies(MapReader& map, const Node& node, RobotTemplate& t) {
    t.numbered = node.find("count") != nullptr;
    t.count = int(map.integer("count", 1, 0, 1'000'000));
    t.placement = read_placement(map, problems_);
    const Placement& p = t.placement;
    if (t.numbered || p.kind == Placement::Kind::random) return;
    const std::size_t copies =
        p.kind == Placement::Kind::grid ? std::size_t(p.columns) * std::size_t(p.rows) : p.poses.size();
    t.numbered = copies > 1;
    t.count = int(copies);
  }

  void read_joint_positions(MapReader& map, RobotTemplate& t) {
    const Node& joints = map.map("joints");
    for (std::size_t i = 0; i < joints.map.size(); ++i) {
      const auto& [joint, value] = joints.map[i];
      const auto position = as_number(value);
      if (!position || !limits::within(limits::joint_position, *position))
        problems_.add(value.location,
                      fmt::format("joint `{}` of {} must have a number from -1e6 to 1e6 as its position, not {}", joint,
                                  map.what(), quoted(value)));
      t.joints.push_back({{joint, joints.key_locations[i]}, position.value_or(0)});
    }
  }

  void read_body(MapReader& map, const Node& node, RobotTemplate& t) {
    const Node* model = map.find("model");
    if (model) {
      t.from_world = map.text("model", "") == "world";
      if (!t.from_world) t.model = resolve_path(model->location, map.text("model", ""));
      t.location = model->location;
    }
    if (t.from_world)
      for (const char* key : {"count", "place", "at"})
        if (map.has(key))
          map.problem(key, "is not allowed with `model: world`: the world file states the pose of the model");
    t.shape = read_shape(map, t.mesh, t.texture, problems_);
    if (t.shape && t.shape->kind == ShapeKind::plane)
      map.problem("shape", "must have a volume: box, sphere, cylinder, capsule or mesh; `plane` is for scenery");
    t.mass = map.number("mass", 0, limits::min_mass, limits::max_mass);
    if (node.kind == Node::Kind::map) check_body(map, node, t);
  }

  /// A robot has a model, or a shape with a mass.
  void check_body(MapReader& map, const Node& node, const RobotTemplate& t) {
    const bool model = node.find("model") != nullptr;
    if (model && t.shape)
      map.problem("shape", "and `model` exclude each other: both say what it consists of, so drop one");
    else if (!model && !t.shape)
      problems_.add(node.location,
                    fmt::format("{} needs a `model: FILE`, or a `shape` with a `mass`{}", map.what(),
                                node.location.in_file() ? "" : did_you_mean(t.name, names_other_than(t.name))));
    else if (model && map.has("mass"))
      map.problem("mass", "belongs to a `shape`; a model states it itself");
    else if (t.shape && !map.has("mass"))
      problems_.add(node.location, map.what() + " needs a `mass` in kg");
  }

  std::vector<std::string> names_other_than(const std::string& name) const {
    std::vector<std::string> names = robot_names_;
    std::erase(names, name);
    return names;
  }

  /// Reads subsystems: every key that is not read yet must be one. Robots with the same variants share one list.
  void read_subsystems(const MapReader& map, const std::vector<Variant>& variants, RobotTemplate& t) {
    const Node subsystems = subsystem_nodes(map, t);
    for (UnknownSubsystem& u : unknown_switched_off(subsystems, subsystem_names_, map.what()))
      take_unknown(std::move(u), t);
    std::map<std::vector<std::size_t>, std::size_t> numbers;  // index of the list, by the variants of a robot
    std::map<int, std::vector<std::size_t>> changes;          // variants that begin or end with a robot
    for (std::size_t v = 0; v < variants.size(); ++v) {
      changes[variants[v].first].push_back(v);
      changes[variants[v].last + 1].push_back(v);
    }
    std::set<std::size_t> present;
    std::size_t list = 0;
    for (int i = 0; i < t.count; ++i) {
      const auto change = changes.find(i);
      if (change != changes.end())
        for (const std::size_t v : change->second)
          if (!present.insert(v).second) present.erase(v);
      if (i == 0 || change != changes.end()) {
        const std::vector<std::size_t> indices(present.begin(), present.end());
        auto known = numbers.find(indices);
        if (known == numbers.end())
          known = numbers
                      .emplace(indices, t.subsystems.add_list(subsystems_of(merged(subsystems, variants, indices),
                                                                            map.what(), has_model(t))))
                      .first;
        list = known->second;
      }
      t.subsystems.add(list);
    }
    if (t.count == 0) subsystems_of(subsystems, map.what(), has_model(t));  // finds their mistakes
  }

  Node subsystem_nodes(const MapReader& map, RobotTemplate& t) {
    Node nodes;
    nodes.kind = Node::Kind::map;
    for (const auto& [key, value] : map.unread()) {
      const Location at = map.key_location(key);
      if (is_subsystem(*value) || value->is_off() || value->kind == Node::Kind::map) nodes.child(key, at) = *value;
      if (is_subsystem(*value) || value->is_off()) continue;
      if (value->kind == Node::Kind::map)
        take_unknown({key, at,
                      fmt::format("subsystem `{}` of {} needs `use: NAME`{}; `muro plugins list` shows the names", key,
                                  map.what(), did_you_mean(key, template_keys))},
                     t);
      else
        problems_.add(
            at, fmt::format("{} has no key `{}`{}; allowed: {}, and subsystems {{use: NAME, ...}}", map.what(), key,
                            did_you_mean(key, template_keys), comma_separated(template_keys)));
    }
    return nodes;
  }

  /// `with_model`: also subsystems that only change, or switch off, a subsystem of the model.
  std::vector<Subsystem> subsystems_of(const Node& nodes, const std::string& owner, bool with_model) {
    std::vector<Subsystem> all;
    for (std::size_t i = 0; i < nodes.map.size(); ++i) {
      const auto& [key, value] = nodes.map[i];
      const bool changes_model = with_model && (value.is_off() || value.kind == Node::Kind::map);
      if (!is_subsystem(value) && !changes_model) continue;
      if (!check_name(key, nodes.key_locations[i], "a subsystem", problems_)) continue;
      if (value.is_off())
        all.emplace_back().name = key, all.back().switched_off = true;
      else if (has_levels(value))
        for (Subsystem& s : read_levels(key, value, owner, problems_)) all.push_back(std::move(s));
      else
        all.push_back(read_subsystem(key, value, owner, problems_));
    }
    return all;
  }

  const Node& robots_;
  Problems& problems_;
  std::vector<std::string> robot_names_;
  std::vector<std::string> subsystem_names_;  ///< names of all robots, each once
  std::unordered_set<std::string> known_subsystem_names_;
};

}  // namespace

std::vector<RobotTemplate> read_robots(const Node& robots, Problems& problems) {
  return RobotReader(robots, problems).read();
}

}  // namespace muro::host
