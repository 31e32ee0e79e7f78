// SPDX-License-Identifier: MIT
#include "host/scenario/robot.hpp"

#include <algorithm>
#include <charconv>

#include "host/scenario/levels.hpp"
#include "host/scenario/parts.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

namespace {

const std::vector<std::string> template_keys = {"model",   "shape", "mass", "friction", "restitution",      "color",
                                                "count",   "place", "at",   "velocity", "angular_velocity", "joints",
                                                "variants"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Robots `first` to `last` of a template differ in `changes`.
struct Variant {
  int first, last;
  const Node* changes;
};

class RobotReader {
 public:
  RobotReader(const Node& robots, Problems& problems) : robots_(robots), problems_(problems) {
    for (const auto& [name, robot] : robots.map) {
      if (!robot.is_off()) robot_names_.push_back(name);
      collect_subsystems(robot);
      if (const Node* variants = robot.find("variants"))
        for (const auto& [range, changes] : variants->map) collect_subsystems(changes);
    }
  }

  std::vector<RobotTemplate> read() {
    check_off(robots_, robot_names_, "`robots`", problems_);
    std::vector<RobotTemplate> all;
    for (std::size_t i = 0; i < robots_.map.size(); ++i) {
      const auto& [name, robot] = robots_.map[i];
      if (robot.is_off() || !check_name(name, robots_.key_locations[i], "a robot", problems_)) continue;
      all.push_back(read_template(name, robot));
    }
    return all;
  }

 private:
  void collect_subsystems(const Node& robot) {
    for (const auto& [key, value] : robot.map)
      if ((is_subsystem(value) || (value.is_off() && value.replaces)) && !contains(subsystem_names_, key))
        subsystem_names_.push_back(key);
  }

  RobotTemplate read_template(const std::string& name, const Node& node) {
    const std::string what = "robot `" + name + "`";
    Section s(node, what, problems_);
    RobotTemplate t;
    t.name = name;
    t.location = node.location;
    read_body(s, node, t);
    t.counted = node.find("count") != nullptr;
    t.count = int(s.integer("count", 1, 0, 1'000'000));
    t.placement = read_placement(s, problems_);
    if (!t.counted && t.placement.form != Placement::Form::random) {
      const Placement& p = t.placement;
      const std::size_t copies =
          p.form == Placement::Form::grid ? std::size_t(p.columns) * std::size_t(p.rows) : p.list.size();
      t.counted = copies > 1;
      t.count = int(copies);
    }
    t.linear_velocity = s.vector("velocity", Vec3::Zero());
    t.angular_velocity = s.vector("angular_velocity", Vec3::Zero());
    const Node& joints = s.map("joints");
    for (std::size_t i = 0; i < joints.map.size(); ++i) {
      const auto& [joint, value] = joints.map[i];
      const auto x = as_number(value);
      if (!x)
        problems_.add(value.location,
                      "joint `" + joint + "` of " + what + " must have a number as its position, not " + shown(value));
      t.joints.push_back({{joint, joints.key_locations[i]}, x.value_or(0)});
    }
    const Node& variants = s.map("variants");
    if (node.kind == Node::Kind::map) read_subsystems(s, read_variants(variants, s, t.count), t);
    return t;
  }

  void read_body(Section& s, const Node& node, RobotTemplate& t) {
    const Node* model = s.find("model");
    if (model) {
      t.from_world = s.text("model", "") == "world";
      if (!t.from_world) t.model = file_beside(model->location, s.text("model", ""));
      t.location = model->location;
    }
    if (t.from_world)
      for (const char* key : {"count", "place", "at"})
        if (s.has(key)) s.problem(key, "does not go with `model: world`: the model stands where the world file says");
    std::string mesh;
    t.shape = read_shape(s, mesh, problems_);
    if (t.shape && (t.shape->kind == ShapeKind::plane || t.shape->kind == ShapeKind::mesh))
      s.problem("shape", "must have a volume: box, sphere, cylinder or capsule; `plane` and `mesh` are for scenery");
    t.mass = s.number("mass", 0, 1e-9, 1e9);
    if (node.kind != Node::Kind::map) return;
    if (model && t.shape)
      s.problem("shape", "and `model` exclude each other: both say what it consists of, so drop one");
    else if (!model && !t.shape)
      problems_.add(node.location, s.what() + " needs a `model: FILE`, or a `shape` with a `mass`" +
                                       (node.location.in_file() ? "" : did_you_mean(t.name, others_than(t.name))));
    else if (model && s.has("mass"))
      s.problem("mass", "goes with `shape`; a model says it itself");
    else if (t.shape && !s.has("mass"))
      problems_.add(node.location, s.what() + " needs a `mass` in kg");
  }

  std::vector<std::string> others_than(const std::string& name) const {
    std::vector<std::string> names = robot_names_;
    names.erase(std::remove(names.begin(), names.end(), name), names.end());
    return names;
  }

  /// Checks `variants: {"0-4": {...}}`.
  std::vector<Variant> read_variants(const Node& variants, const Section& s, int count) {
    const auto others = s.others();
    std::vector<std::string> own;
    for (const auto& [key, value] : others)
      if (is_subsystem(*value) || value->is_off()) own.push_back(key);
    std::vector<Variant> all;
    for (std::size_t v = 0; v < variants.map.size(); ++v) {
      const auto& [range, changes] = variants.map[v];
      const std::string what = "variant `" + range + "` of " + s.what();
      if (const auto r = range_of(range); r && r->second < count)
        all.push_back({r->first, r->second, &changes});
      else
        problems_.add(variants.key_locations[v], what + " must be a number or a range such as 0-4" +
                                                     (count > 0 ? ", within 0-" + std::to_string(count - 1)
                                                                : std::string(", and there is no such robot")));
      if (changes.kind != Node::Kind::map) {
        problems_.add(changes.location,
                      what + " is " + shown(changes) + " but must be a map of the subsystems that differ");
        continue;
      }
      check_off(changes, subsystem_names_, what, problems_);
      for (std::size_t i = 0; i < changes.map.size(); ++i) {
        const auto& [key, change] = changes.map[i];
        const Location& at = changes.key_locations[i];
        if (contains(template_keys, key))
          problems_.add(at, what + " changes `" + key +
                                "`, which belongs to all robots of the template; variants change subsystems");
        else if (change.kind == Node::Kind::map && !is_subsystem(change) && !contains(own, key))
          problems_.add(at, what + " changes `" + key + "`, but the template has no subsystem of this name" +
                                did_you_mean(key, own) + (own.empty() ? "" : "; it has: " + listed(own)));
        else if (change.kind != Node::Kind::map && !change.is_off())
          problems_.add(change.location,
                        "`" + key + "` of " + what + " is " + shown(change) + " but must be a map or `off`");
      }
    }
    return all;
  }

  /// "3" or "0-4".
  static std::optional<std::pair<int, int>> range_of(const std::string& text) {
    const char* end = text.data() + text.size();
    int first = 0;
    auto r = std::from_chars(text.data(), end, first);
    int last = first;
    if (r.ec == std::errc{} && r.ptr != end && *r.ptr == '-') r = std::from_chars(r.ptr + 1, end, last);
    if (r.ec != std::errc{} || r.ptr != end || first < 0 || last < first) return std::nullopt;
    return std::pair(first, last);
  }

  /// Whatever no other key is must be a subsystem. Robots with the same variants share one list of them.
  void read_subsystems(const Section& s, const std::vector<Variant>& variants, RobotTemplate& t) {
    Node parts;
    parts.kind = Node::Kind::map;
    for (const auto& [key, value] : s.others()) {
      const Location at = s.key_location(key);
      if (is_subsystem(*value) || value->is_off())
        parts.child(key, at) = *value;
      else if (value->kind == Node::Kind::map)
        problems_.add(at, "subsystem `" + key + "` of " + s.what() + " needs `use: NAME`" +
                              did_you_mean(key, template_keys) + "; `muro plugins list` shows the names");
      else
        problems_.add(at, s.what() + " has no key `" + key + "`" + did_you_mean(key, template_keys) +
                              "; allowed: " + listed(template_keys) + ", and subsystems {use: NAME, ...}");
    }
    check_off(parts, subsystem_names_, s.what(), problems_);
    std::map<std::vector<std::size_t>, std::vector<Subsystem>> known;
    for (int i = 0; i < t.count; ++i) {
      std::vector<std::size_t> which;
      for (std::size_t v = 0; v < variants.size(); ++v)
        if (variants[v].first <= i && i <= variants[v].last) which.push_back(v);
      auto entry = known.find(which);
      if (entry == known.end()) {
        Node changed = parts;
        for (const std::size_t v : which)
          for (const auto& [key, change] : variants[v].changes->map) {
            Node& part = changed.child(key, change.location);
            merge(part, change);
            part.location = change.location;
          }
        entry = known.emplace(which, subsystems_of(changed, s.what())).first;
      }
      t.subsystems.push_back(entry->second);
    }
    if (t.count == 0) subsystems_of(parts, s.what());  // their mistakes are told all the same
  }

  std::vector<Subsystem> subsystems_of(const Node& parts, const std::string& owner) {
    std::vector<Subsystem> all;
    for (std::size_t i = 0; i < parts.map.size(); ++i) {
      const auto& [key, value] = parts.map[i];
      if (!is_subsystem(value) || !check_name(key, parts.key_locations[i], "a subsystem", problems_)) continue;
      if (has_levels(value))
        for (Subsystem& s : read_levels(key, value, owner, problems_)) all.push_back(std::move(s));
      else
        all.push_back(read_subsystem(key, value, owner, problems_));
    }
    return all;
  }

  const Node& robots_;
  Problems& problems_;
  std::vector<std::string> robot_names_;
  std::vector<std::string> subsystem_names_;  ///< of all robots
};

}  // namespace

bool is_subsystem(const Node& n) {
  return n.kind == Node::Kind::map && (n.find("use") != nullptr || n.find("levels") != nullptr);
}

Subsystem read_subsystem(const std::string& name, const Node& n, const std::string& owner, Problems& problems) {
  const std::string what = "`" + name + "` of " + owner;
  Section s(n, what, problems);
  Subsystem sub;
  sub.name = name;
  sub.location = n.location;
  sub.use = s.text("use", "");
  if (const Node* rate = s.find("rate")) {
    sub.on_demand = rate->kind == Node::Kind::scalar && rate->scalar == "on_demand";
    const auto hertz = as_number(*rate);
    if (hertz && *hertz >= 1e-6 && *hertz <= 1e9)
      sub.rate = *hertz;
    else if (!sub.on_demand)
      s.problem("rate", "is " + shown(*rate) + " but must be a number from 1e-06 to 1e+09 in Hz, or on_demand");
  }
  if (const Node* shadow = s.find("shadow")) {
    if (is_subsystem(*shadow) && !has_levels(*shadow))
      sub.shadow = std::make_shared<Subsystem>(read_subsystem(name, *shadow, "the shadow of " + owner, problems));
    else
      s.problem("shadow", "must be a map {use: NAME, ...} of the motion that moves the shadow");
  }
  if (s.has("phase")) sub.phase = s.number("phase", 0, 0, 1e9);
  sub.on = s.text("on", "");
  if (const Node* on = n.find("on")) sub.on_location = on->location;
  const auto take = [&](const std::string& key, const Node& value) {
    if (const auto p = as_parameter(value))
      sub.parameters[key] = *p;
    else
      problems.add(value.location, "parameter `" + key + "` of " + what +
                                       " must be a single value or a flat list, not " + shown(value));
  };
  for (const auto& [key, value] : s.others()) {
    if (key.find('.') == std::string::npos) {
      take(key, *value);
      continue;
    }
    // parameters under the name of an algorithm count only for that algorithm
    const Node& parameters = s.map(key);
    sub.alternatives.push_back({key, s.key_location(key)});
    if (key == sub.use)
      for (const auto& [inner, v] : parameters.map) take(inner, v);
  }
  return sub;
}

std::vector<RobotTemplate> read_robots(const Node& robots, Problems& problems) {
  return RobotReader(robots, problems).read();
}

}  // namespace muro::host
