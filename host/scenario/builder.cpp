// SPDX-License-Identifier: MIT
#include "host/scenario/builder.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "host/scenario/body.hpp"
#include "host/scenario/defaults.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/section.hpp"
#include "muro/nearest.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

class SceneBuilder {
 public:
  SceneBuilder(BuiltScenario& out, Registry& registry)
      : out_(out),
        scenario_(out.scenario),
        registry_(registry),
        simulation_(*out.simulation),
        world_(simulation_.world()) {}

  void build() {
    world_.set(world_object, keys::gravity, scenario_.gravity);
    for (const SceneryObject& o : scenario_.objects) collecting("", [&] { add_object(o); });
    add_all_robots();
    for (const Subsystem& s : scenario_.algorithms) add_to_scene(s);
    add_kinematics();
    add_defaults();
    for (const auto& sequence : scenario_.sequences) add_sequence(sequence);
    problems_.check();
  }

 private:
  /// Runs `work`; what it throws is told with all other problems, behind `prefix`. Returns whether it threw nothing.
  template <class Work>
  bool collecting(const std::string& prefix, Work work) {
    try {
      work();
      return true;
    } catch (const SetupError& e) {
      std::istringstream lines(e.what());
      for (std::string line; std::getline(lines, line);) problems_.add(prefix + line);
      return false;
    }
  }

  void add_object(const SceneryObject& o) {
    const Placement& p = o.placement;
    Shape shape = o.shape;
    if (!o.mesh.empty()) shape.mesh = world_.intern(o.mesh);
    const Vec3 half = half_extents(shape);
    const bool plane = shape.kind == ShapeKind::plane;
    const int count = p.form == Placement::Form::grid ? p.columns * p.rows : int(p.list.size());
    std::vector<Footprint> unused;
    const auto poses =
        place(p, count, plane ? 0 : half.z(), std::hypot(half.x(), half.y()), scenario_.places, {}, unused, o.name);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      collecting(o.location.text() + ": ", [&] {
        world_.add_scenery(numbered(o.name, o.counted, i), poses[i], std::span<const Shape>(&shape, 1));
      });
      if (!plane) obstacles_.push_back({poses[i], half.x(), half.y()});
    }
  }

  static std::string numbered(const std::string& name, bool counted, std::size_t i) {
    return counted ? name + "_" + std::to_string(i) : name;
  }

  RobotTree model_of(const RobotTemplate& t) {
    if (t.shape) return single_body(*t.shape, t.mass);
    RobotTree tree = simulation_.read_model(t.model);
    for (const auto& p : tree.problems())
      out_.notes.push_back(t.model + (p.line > 0 ? ":" + std::to_string(p.line) + ":" + std::to_string(p.column) : "") +
                           ": " + (p.severity == Severity::warning ? "warning: " : "note: ") + p.text);
    return tree;
  }

  /// Robots with given places come first, so that random ones keep clear of all of them.
  void add_all_robots() {
    std::vector<std::optional<RobotTree>> trees(scenario_.robots.size());
    std::vector<std::vector<Pose>> poses(scenario_.robots.size());
    for (const bool random : {false, true})
      for (std::size_t i = 0; i < trees.size(); ++i) {
        RobotTemplate& t = scenario_.robots[i];
        if ((t.placement.form == Placement::Form::random) != random) continue;
        if (!collecting(t.location.text() + ": robot `" + t.name + "`: ", [&] { trees[i] = model_of(t); })) continue;
        if (!t.placement.seed) t.placement.seed = scenario_.seed;
        collecting("", [&] {
          poses[i] = place(t.placement, t.count, trees[i]->standing_height(), trees[i]->footprint_radius(),
                           scenario_.places, obstacles_, footprints_, t.name);
        });
      }
    for (std::size_t i = 0; i < trees.size(); ++i)
      if (trees[i]) add_robots(scenario_.robots[i], *trees[i], poses[i]);
  }

  void add_robots(const RobotTemplate& t, const RobotTree& tree, const std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RobotView* added = nullptr;
      if (!collecting(t.location.text() + ": ",
                      [&] { added = &world_.add_robot(numbered(t.name, t.counted, i), tree, poses[i]); }))
        continue;
      const RobotView& robot = *added;
      world_.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
      for (const auto& [joint, position] : t.joints) set_joint(t, robot, joint, position);
      if (add_subsystems(t, robot, t.subsystems[i])) continue;
      world_.set(robot.base(), keys::pose, poses[i]);  // a parked robot
      world_.set(robot.base(), keys::twist, Twist{});
    }
  }

  void set_joint(const RobotTemplate& t, const RobotView& robot, const Name& joint, double position) {
    const ObjectId object = world_.find_object(std::string(robot.name) + "/" + joint.text);
    const bool known = std::any_of(robot.frames.begin(), robot.frames.end(),
                                   [&](const Frame& f) { return object != no_object && f.joint_object == object; });
    if (known) return world_.set(object, keys::initial_joint_position, position);
    std::vector<std::string> names;
    for (const Frame& f : robot.frames)
      if (f.joint_object != no_object) names.push_back(part_name(robot, f.joint_object));
    problems_.add(joint.location, "robot `" + t.name + "` has no joint `" + joint.text + "`" +
                                      did_you_mean(joint.text, names) +
                                      (names.empty() ? "" : "; it has: " + listed(names)));
  }

  std::string part_name(const RobotView& robot, ObjectId object) const {
    return world_.object_name(object).substr(robot.name.size() + 1);
  }

  /// The object "robot/part" that `on:` names.
  ObjectId mount(const RobotView& robot, const Subsystem& s) {
    const ObjectId object = world_.find_object(std::string(robot.name) + "/" + s.on);
    if (object != no_object) return object;
    std::vector<std::string> parts;
    for (std::uint32_t i = 0; i < world_.object_count(); ++i)
      if (world_.robot_of(ObjectId{i}) == std::int32_t(robot.number)) parts.push_back(part_name(robot, ObjectId{i}));
    problems_.add(s.on_location, "`on: " + s.on + "` of `" + s.name + "`: the robot has no part of this name" +
                                     did_you_mean(s.on, parts) + "; it has: " + listed(parts));
    return robot.base();
  }

  /// Sensors first: what belongs to one may stand before it in the file. Returns whether something moves the robot.
  bool add_subsystems(const RobotTemplate& t, const RobotView& robot, const std::vector<Subsystem>& subsystems) {
    bool moved = false;
    for (const bool sensors : {true, false})
      for (const Subsystem& s : subsystems) {
        const Description* d = describe(s);
        if (!d) {
          moved = true;
        } else if ((d->kind == Kind::sensor) == sensors) {
          moved = add_subsystem(t, robot, s, *d, subsystems) || moved;
        }
      }
    return moved;
  }

  /// Returns whether the algorithm moves the robot.
  bool add_subsystem(const RobotTemplate& t, const RobotView& robot, Subsystem s, const Description& d,
                     const std::vector<Subsystem>& others) {
    Item item{&robot, robot.base()};
    switch (d.kind) {
      case Kind::scene:
      case Kind::collision:
      case Kind::contact:
      case Kind::recorder:
      case Kind::view:
        problems_.add(s.location, "`" + s.use + "` serves the whole scene; name it under `algorithms`, not in robot `" +
                                      t.name + "`");
        return false;
      case Kind::sensor: {
        const ObjectId link = s.on.empty() ? robot.base() : mount(robot, s);
        if (world_.find_object(std::string(robot.name) + "/" + s.name) != no_object) {
          problems_.add(s.location,
                        "sensor `" + s.name + "` has the name of a part of robot `" + t.name + "`; give it another");
          return false;
        }
        item.object = simulation_.add_sensor_object(robot, s.name, link);
        break;
      }
      case Kind::sensor_error: {
        const auto sensor =
            std::find_if(others.begin(), others.end(), [&](const Subsystem& o) { return o.name == s.on; });
        if (sensor == others.end() || !is_kind(*sensor, Kind::sensor)) {
          std::vector<std::string> sensors;
          for (const Subsystem& o : others)
            if (is_kind(o, Kind::sensor)) sensors.push_back(o.name);
          problems_.add(
              s.on.empty() ? s.location : s.on_location,
              "`" + s.name + "` needs `on:` with the name of the sensor whose readings it changes" +
                  did_you_mean(s.on, sensors) +
                  (sensors.empty() ? "; robot `" + t.name + "` has no sensor" : "; there are: " + listed(sensors)));
          return false;
        }
        // one run for each reading
        if (!s.rate && !s.on_demand) s.rate = sensor->rate, s.on_demand = sensor->on_demand;
        if (!s.phase) s.phase = sensor->phase;
        item.object = mount(robot, s);
        break;
      }
      default:
        if (!s.on.empty()) item.object = mount(robot, s);
    }
    if (d.kind == Kind::kinematics) has_kinematics_.insert(robot.number);
    const bool batched = (d.promises & Promise::batched) != 0;
    add_algorithm(s, (batched ? t.name : std::string(robot.name)) + "." + s.name, {item}, t.name + "." + s.name);
    return d.kind == Kind::motion;
  }

  void add_to_scene(const Subsystem& s) {
    const Description* d = describe(s);
    if (!d) return;
    switch (d->kind) {
      case Kind::motion:
      case Kind::drive:
      case Kind::sensor:
      case Kind::sensor_error:
        problems_.add(s.location, "`" + s.use + "` serves a robot; name it in a robot, not under `algorithms`");
        break;
      case Kind::kinematics: {
        std::vector<Item> items;
        for (const RobotView* r : world_.robots())
          if (r->frames.size() > 1 && has_kinematics_.insert(r->number).second) items.push_back({r, r->base()});
        if (!items.empty()) add_algorithm(s, s.name, std::move(items));
        break;
      }
      default:
        add_algorithm(s, s.name, {});
    }
  }

  const Description* describe(const Subsystem& s) {
    const Description* d = nullptr;
    collecting(s.location.text() + ": ", [&] { d = registry_.algorithm(s.use).description; });
    return d;
  }

  bool is_kind(const Subsystem& s, Kind kind) {
    const Description* d = describe(s);
    return d && d->kind == kind;
  }

  /// `alias`: another name under which sequences may call it.
  void add_algorithm(const Subsystem& s, const std::string& name, std::vector<Item> items,
                     const std::string& alias = "") {
    const Description* d = describe(s);
    for (const Name& other : s.alternatives)
      collecting(other.location.text() + ": parameters of `" + s.name + "`: ", [&] { registry_.find(other.text); });
    if (!d) return;
    AlgorithmSetup setup;
    setup.name = name;
    setup.use = s.use;
    setup.subsystem = s.name;
    setup.parameters = s.parameters;
    setup.items = std::move(items);
    setup.place = s.location.text();
    const std::filesystem::path file(s.location.in_file() ? s.location.file : scenario_.file);
    setup.folder = std::filesystem::absolute(file).parent_path().string();
    setup.phase = std::llround(s.phase.value_or(0) * 1e9);
    const std::optional<double> rate = s.rate ? s.rate : default_rate(d->kind);
    if (s.on_demand && !may_run_on_demand(d->kind))
      problems_.add(s.location, "`" + s.name + "` cannot run on demand, since nobody asks a " +
                                    std::string(name_of(d->kind)) + " for what it does; give it a `rate` in Hz");
    else if (!s.on_demand && !rate)
      problems_.add(s.location, "`" + s.name + "` needs a `rate` in Hz: how often `" + s.use + "` runs");
    else if (!s.on_demand)
      setup.rate = Rate(*rate);
    used_.insert(s.use);
    const Rate scheduled = setup.rate;
    const std::int64_t phase = setup.phase;
    const Added added{simulation_.add(std::move(setup)), scheduled, phase};
    added_[name].push_back(added);
    if (!alias.empty() && alias != name) added_[alias].push_back(added);
  }

  bool is_off(const char* name) const {
    const auto& off = scenario_.switched_off;
    return std::find(off.begin(), off.end(), name) != off.end();
  }

  /// Adds an algorithm that the scenario does not name; `reason` says in an error why it is needed.
  void add_unnamed(const std::string& name, const std::string& use, const std::string& reason,
                   std::vector<Item> items) {
    Subsystem s;
    s.name = name;
    s.use = use;
    s.location = {scenario_.file, 0, 0};
    const std::string why = scenario_.file + ": " + reason + ", by default `" + use +
                            "` (another goes under `algorithms: {" + name + ": {use: NAME}}`): ";
    if (collecting(why, [&] { registry_.algorithm(use); })) add_algorithm(s, name, std::move(items));
  }

  void add_kinematics() {
    if (is_off("kinematics")) return;
    for (const RobotView* r : world_.robots())
      if (r->frames.size() > 1 && has_kinematics_.count(r->number) == 0)
        add_unnamed("kinematics", "kinematics.direct", "robots of several bodies need kinematics",
                    {Item{r, r->base()}});
  }

  void add_defaults() {
    const auto user = [&](const char* property, std::vector<std::string> Offer::*list) {
      return std::find_if(used_.begin(), used_.end(), [&](const std::string& id) {
        const auto& names = registry_.find(id).*list;
        return std::find(names.begin(), names.end(), property) != names.end();
      });
    };
    for (const Default& d : defaults) {
      const auto reader = user(d.property, &Offer::reads);
      if (is_off(d.name) || reader == used_.end() || user(d.property, &Offer::writes) != used_.end()) continue;
      add_unnamed(d.name, d.use, "`" + *reader + "` reads `" + d.property + "`, so something must write it", {});
    }
  }

  void add_sequence(const std::vector<Name>& sequence) {
    std::vector<std::size_t> numbers;
    const Added* first = nullptr;  // of those that have a rate
    for (const Name& name : sequence) {
      const auto known = added_.find(name.text);
      if (known == added_.end()) {
        std::vector<std::string> names;
        for (const auto& [n, unused] : added_) names.push_back(n);
        problems_.add(name.location, "no algorithm is named `" + name.text + "`" + did_you_mean(name.text, names));
        return;
      }
      for (const Added& a : known->second) {
        numbers.push_back(a.number);
        if (a.rate.on_demand()) continue;
        if (!first) first = &a;
        if (a.rate == first->rate && a.phase == first->phase) continue;
        problems_.add(
            name.location,
            "`" + name.text + "` has another rate or phase than what stands before it; a sequence runs at one rate");
        return;
      }
    }
    if (!numbers.empty() && !first)
      return problems_.add(sequence.front().location,
                           "all algorithms of the sequence run on demand; one of them needs a rate");
    if (numbers.size() > 1) simulation_.add_sequence(std::move(numbers));
  }

  struct Added {
    std::size_t number;
    Rate rate;
    std::int64_t phase;
  };
  BuiltScenario& out_;
  Scenario& scenario_;
  Registry& registry_;
  Simulation& simulation_;
  World& world_;
  Problems problems_;
  std::vector<Obstacle> obstacles_;
  std::vector<Footprint> footprints_;
  std::set<std::string> used_;
  std::set<std::uint32_t> has_kinematics_;
  std::map<std::string, std::vector<Added>> added_;
};

}  // namespace

BuiltScenario build(Scenario scenario, Registry& registry) {
  BuiltScenario out;
  out.scenario = std::move(scenario);
  out.simulation = std::make_unique<Simulation>(registry, out.scenario.seed);
  SceneBuilder(out, registry).build();
  out.simulation->build();
  return out;
}

}  // namespace muro::host
