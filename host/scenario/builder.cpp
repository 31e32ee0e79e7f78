// SPDX-License-Identifier: MIT
#include "host/scenario/builder.hpp"

#include <algorithm>
#include <thread>

#include "host/scenario/algorithms.hpp"
#include "host/scenario/body.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/section.hpp"
#include "host/scenario/world_file.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

class SceneBuilder {
 public:
  SceneBuilder(BuiltScenario& out, Registry& registry)
      : out_(out),
        scenario_(out.scenario),
        simulation_(*out.simulation),
        world_(simulation_.world()),
        algorithms_(out.scenario, registry, simulation_, problems_),
        world_file_(out.scenario, simulation_, out.notes, problems_) {}

  void build() {
    world_file_.read();
    world_.set(world_object, keys::gravity, world_file_.gravity());
    world_file_.add_scenery(obstacles_);
    for (const SceneryObject& o : scenario_.objects) problems_.collect("", [&] { add_object(o); });
    add_all_robots();
    algorithms_.complete();
    problems_.check();
  }

 private:
  struct ShadowSetup {
    const RobotTemplate* of;
    const RobotTree* tree;
    Pose pose;
    const RobotView* robot;
    const Subsystem* motion;
  };

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
      problems_.collect(o.location.text() + ": ", [&] {
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
    if (t.from_world) return world_file_.model(t);
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
        if (!problems_.collect(t.location.text() + ": robot `" + t.name + "`: ", [&] { trees[i] = model_of(t); }))
          continue;
        if (t.from_world) {
          poses[i] = {world_file_.pose(t)};
          footprints_.push_back({poses[i][0].position.x(), poses[i][0].position.y(), trees[i]->footprint_radius()});
          continue;
        }
        if (!t.placement.seed) t.placement.seed = scenario_.seed;
        problems_.collect("", [&] {
          poses[i] = place(t.placement, t.count, trees[i]->standing_height(), trees[i]->footprint_radius(),
                           scenario_.places, obstacles_, footprints_, t.name);
        });
      }
    for (std::size_t i = 0; i < trees.size(); ++i)
      if (trees[i]) add_robots(scenario_.robots[i], *trees[i], poses[i]);
    for (const ShadowSetup& s : shadows_) add_shadow(s);
  }

  void add_robots(const RobotTemplate& t, const RobotTree& tree, const std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RobotView* added = nullptr;
      if (!problems_.collect(t.location.text() + ": ",
                             [&] { added = &world_.add_robot(numbered(t.name, t.counted, i), tree, poses[i]); }))
        continue;
      const RobotView& robot = *added;
      world_.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
      for (const auto& [joint, position] : t.joints) set_joint(t, robot, joint, position);
      for (const Subsystem& s : t.subsystems[i])
        if (s.shadow) shadows_.push_back({&t, &tree, poses[i], &robot, s.shadow.get()});
      if (add_subsystems(t, robot, t.subsystems[i])) continue;
      world_.set(robot.base(), keys::pose, poses[i]);  // a parked robot
      world_.set(robot.base(), keys::twist, Twist{});
    }
  }

  /// The robot once more, moved by another motion on the same commands; see keys::shadow_of.
  void add_shadow(const ShadowSetup& setup) {
    const RobotView& robot = *setup.robot;
    const Description* d = algorithms_.describe(*setup.motion);
    if (!d) return;
    if (d->kind != Kind::motion)
      return problems_.add(setup.motion->location, "`" + setup.motion->use + "` is no motion; a motion moves a shadow");
    const std::string name = std::string(robot.name) + ".shadow";
    const RobotView* added = nullptr;
    if (!problems_.collect(setup.motion->location.text() + ": ",
                           [&] { added = &world_.add_robot(name, *setup.tree, setup.pose); }))
      return;
    const RobotTemplate& t = *setup.of;
    world_.set(added->base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
    world_.set(added->base(), keys::shadow_of, robot.base());
    for (const auto& [joint, position] : t.joints) set_joint(t, *added, joint, position);
    world_.share(added->base(), keys::command_twist, robot.base(), keys::command_twist);
    world_.share(added->base(), keys::command_pose, robot.base(), keys::command_pose);
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const ObjectId mine = added->links[i].joint_object, theirs = robot.links[i].joint_object;
      if (mine == no_object) continue;
      for (const Key<double>& key : {keys::joint_velocity_target, keys::joint_position_target,
                                     keys::joint_acceleration_target, keys::joint_effort_target})
        world_.share(mine, key, theirs, key);
    }
    Subsystem motion = *setup.motion;
    if ((d->capabilities & Capability::world) != 0)
      motion.parameters["world"] = "the shadow of " + std::string(robot.name);
    algorithms_.add(motion, name + ".motion", {{added, added->base()}});
    Subsystem measure;
    measure.name = "shadow";
    measure.use = "level.shadow";
    measure.location = setup.motion->location;
    measure.rate = 100;
    algorithms_.add(measure, "shadows", {{added, added->base()}});
  }

  void set_joint(const RobotTemplate& t, const RobotView& robot, const Name& joint, double position) {
    const ObjectId object = world_.find_object(std::string(robot.name) + "/" + joint.text);
    const bool known = std::any_of(robot.links.begin(), robot.links.end(),
                                   [&](const Link& f) { return object != no_object && f.joint_object == object; });
    if (known) return world_.set(object, keys::initial_joint_position, position);
    std::vector<std::string> names;
    for (const Link& f : robot.links)
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
        const Description* d = algorithms_.describe(s);
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
        if (sensor == others.end() || !algorithms_.is_kind(*sensor, Kind::sensor)) {
          std::vector<std::string> sensors;
          for (const Subsystem& o : others)
            if (algorithms_.is_kind(o, Kind::sensor)) sensors.push_back(o.name);
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
    if (s.level) {
      if (d.kind != Kind::motion) {
        problems_.add(s.location, "`" + s.use + "` is no motion; only motions have levels");
        return false;
      }
      item.level = s.level->number;
      if (s.level->number == 0) simulation_.set_levels(robot, s.level->names, s.level->start);
    }
    const bool batched = (d.capabilities & Capability::batched) != 0;
    algorithms_.add(s, (batched ? t.name : std::string(robot.name)) + "." + s.name, {item}, t.name + "." + s.name);
    return d.kind == Kind::motion;
  }

  BuiltScenario& out_;
  Scenario& scenario_;
  Simulation& simulation_;
  World& world_;
  Problems problems_;
  Algorithms algorithms_;
  WorldFileParts world_file_;
  std::vector<Obstacle> obstacles_;
  std::vector<Footprint> footprints_;
  std::vector<ShadowSetup> shadows_;
};

}  // namespace

namespace {

/// What algorithms say to the user.
void print_line(LogLevel level, std::string_view text) {
  if (level == LogLevel::debug) return;
  const char* const kind = level == LogLevel::error ? "error" : level == LogLevel::warning ? "warning" : "note";
  std::fprintf(stderr, "%s: %.*s\n", kind, int(text.size()), text.data());
}

}  // namespace

unsigned all_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

BuiltScenario build(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& more) {
  BuiltScenario out;
  out.scenario = std::move(scenario);
  out.simulation = std::make_unique<Simulation>(registry, out.scenario.seed);
  out.simulation->set_log(print_line);
  SceneBuilder(out, registry).build();
  if (more) more(*out.simulation);
  out.simulation->build();
  out.simulation->set_threads(out.scenario.threads > 0 ? out.scenario.threads : all_threads());
  return out;
}

}  // namespace muro::host
