// SPDX-License-Identifier: MIT
#include "host/scenario/builder.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "muro/nearest.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/section.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// A scene-wide algorithm that is used when something reads `property` and nothing in the scenario writes it.
struct Default {
  const char* property;
  const char* name;
  const char* use;
};
constexpr Default defaults[] = {
    {"wrench.external", "contact", "contact.penalty"},
    {"contacts", "collision", "collision.native"},
    {"scene.index", "index", "scene.bvh"},
};

/// What a rate is when the scenario names none; 0: on demand.
std::optional<double> default_rate(Kind kind) {
  switch (kind) {
    case Kind::motion: return 1000;
    case Kind::kinematics:
    case Kind::scene:
    case Kind::collision:
    case Kind::contact:
    case Kind::drive:
    case Kind::sensor_error: return 0;
    default: return std::nullopt;
  }
}

class SceneBuilder {
 public:
  SceneBuilder(BuiltScenario& out, Registry& registry)
      : out_(out), scenario_(out.scenario), registry_(registry), simulation_(*out.simulation), world_(simulation_.world()) {}

  void build() {
    world_.set(world_object, keys::gravity, scenario_.gravity);
    for (const SceneryObject& o : scenario_.objects) add_object(o);
    for (const RobotTemplate& t : scenario_.robots) add_robots(t);
    for (const Subsystem& s : scenario_.algorithms) add_algorithm(s, s.name, {});
    add_kinematics();
    add_defaults();
    for (std::size_t i = 0; i < scenario_.sequences.size(); ++i) add_sequence(i);
    problems_.check();
  }

 private:
  void add_object(const SceneryObject& o) {
    const Placement& p = o.placement;
    Shape shape = o.shape;
    if (!o.mesh.empty()) shape.mesh = world_.intern(o.mesh);
    const Vec3 half = half_extents(shape);
    const bool plane = shape.kind == ShapeKind::plane;
    const int count = p.form == Placement::Form::grid ? p.columns * p.rows : int(p.list.size());
    std::vector<Footprint> unused;
    const auto poses = place(p, count, plane ? 0 : half.z(), std::hypot(half.x(), half.y()), scenario_.places, {}, unused, o.name);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      world_.add_scenery(numbered(o.name, o.counted, i), poses[i], std::span<const Shape>(&shape, 1));
      if (!plane) obstacles_.push_back({poses[i], half.x(), half.y()});
    }
  }

  static std::string numbered(const std::string& name, bool counted, std::size_t i) {
    return counted ? name + "_" + std::to_string(i) : name;
  }

  RobotTree model_of(const RobotTemplate& t) {
    if (t.shape) {
      RobotTree tree;
      tree.base("body");
      tree.set(keys::inertial, solid(*t.shape, t.mass));
      tree.set_array(keys::collision_shapes, std::span<const Shape>(&*t.shape, 1));
      tree.set_array(keys::visual_shapes, std::span<const Shape>(&*t.shape, 1));
      tree.close();
      return tree;
    }
    try {
      RobotTree tree = simulation_.read_model(t.model);
      for (const auto& p : tree.problems())
        out_.notes.push_back(t.model + (p.line > 0 ? ":" + std::to_string(p.line) + ":" + std::to_string(p.column) : "") + ": " +
                             (p.severity == Severity::warning ? "warning: " : "note: ") + p.text);
      return tree;
    } catch (const SetupError& e) {
      throw SetupError(t.location.text() + ": robot `" + t.name + "`: " + e.what());
    }
  }

  /// Inertia of a homogeneous body.
  static Inertia solid(const Shape& s, double mass) {
    const double r = s.size.x(), l = s.size.z();
    Inertia i{.mass = mass};
    const auto axial = [&](double across, double along) { i.ixx = i.iyy = across, i.izz = along; };
    switch (s.kind) {
      case ShapeKind::box: {
        const Vec3 q = s.size.cwiseProduct(s.size) * (mass / 12);
        i.ixx = q.y() + q.z(), i.iyy = q.x() + q.z(), i.izz = q.x() + q.y();
        break;
      }
      case ShapeKind::cylinder: axial(mass * (3 * r * r + l * l) / 12, mass * r * r / 2); break;
      case ShapeKind::capsule: {
        const double tube = r * r * l, balls = 4.0 / 3 * r * r * r, mt = mass * tube / (tube + balls), mb = mass - mt;
        axial(mt * (3 * r * r + l * l) / 12 + mb * (0.4 * r * r + l * l / 4 + 3.0 / 8 * l * r), mt * r * r / 2 + mb * 0.4 * r * r);
        break;
      }
      default: axial(0.4 * mass * r * r, 0.4 * mass * r * r);
    }
    return i;
  }

  void add_robots(const RobotTemplate& t) {
    const RobotTree tree = model_of(t);
    const auto poses = place(t.placement, t.count, tree.standing_height(), tree.footprint_radius(), scenario_.places, obstacles_,
                             footprints_, t.name);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RobotView& robot = world_.add_robot(numbered(t.name, t.counted, i), tree, poses[i]);
      world_.set(robot.base(), keys::initial_twist, Twist{t.linear_velocity, t.angular_velocity});
      for (const auto& [joint, position] : t.joints) set_joint(t, robot, joint, position);
      bool moved = false;
      for (const Subsystem& s : t.subsystems[i]) moved = add_to_robot(t, robot, s) || moved;
      if (!moved) {  // a parked robot
        world_.set(robot.base(), keys::pose, poses[i]);
        world_.set(robot.base(), keys::twist, Twist{});
      }
    }
  }

  void set_joint(const RobotTemplate& t, const RobotView& robot, const std::string& joint, double position) {
    const ObjectId object = world_.find_object(std::string(robot.name) + "/" + joint);
    const bool known = std::any_of(robot.frames.begin(), robot.frames.end(),
                                   [&](const Frame& f) { return object != no_object && f.joint_object == object; });
    if (known) return world_.set(object, keys::initial_joint_position, position);
    std::vector<std::string> names;
    for (const Frame& f : robot.frames)
      if (f.joint_object != no_object) names.push_back(part_name(robot, f.joint_object));
    problems_.add(t.location, "robot `" + t.name + "` has no joint `" + joint + "`" + did_you_mean(joint, names));
  }

  std::string part_name(const RobotView& robot, ObjectId object) const {
    return world_.object_name(object).substr(robot.name.size() + 1);
  }

  /// The object "robot/part" that `on:` names.
  ObjectId mount(const RobotView& robot, const Subsystem& s) {
    const ObjectId object = world_.find_object(std::string(robot.name) + "/" + s.on);
    if (object != no_object) return object;
    std::vector<std::string> parts;
    std::string all;
    for (std::uint32_t i = 0; i < world_.object_count(); ++i)
      if (world_.robot_of(ObjectId{i}) == std::int32_t(robot.number)) {
        parts.push_back(part_name(robot, ObjectId{i}));
        all += (all.empty() ? "" : ", ") + parts.back();
      }
    problems_.add(s.location, "`on: " + s.on + "` of `" + s.name + "`: the robot has no part of this name" +
                                  did_you_mean(s.on, parts) + "; it has: " + all);
    return robot.base();
  }

  /// Returns whether the algorithm moves the robot.
  bool add_to_robot(const RobotTemplate& t, const RobotView& robot, const Subsystem& s) {
    const Description* d = describe(s);
    if (!d) return true;
    Item item{&robot, robot.base()};
    switch (d->kind) {
      case Kind::scene:
      case Kind::collision:
      case Kind::contact:
        problems_.add(s.location, "`" + s.use + "` serves the whole scene; name it under `algorithms`, not in robot `" + t.name + "`");
        return false;
      case Kind::sensor: {
        const ObjectId link = s.on.empty() ? robot.base() : mount(robot, s);
        item.object = world_.find_object(std::string(robot.name) + "/" + s.name);
        if (item.object != no_object) {
          problems_.add(s.location, "sensor `" + s.name + "` has the name of a part of robot `" + t.name + "`; give it another");
          return false;
        }
        item.object = simulation_.add_sensor_object(robot, s.name, link);
        break;
      }
      case Kind::sensor_error:
        if (s.on.empty()) {
          problems_.add(s.location, "`" + s.name + "` needs `on:` with the name of the sensor whose readings it changes");
          return false;
        }
        item.object = mount(robot, s);
        break;
      default:
        if (!s.on.empty()) item.object = mount(robot, s);
    }
    const bool batched = (d->promises & Promise::batched) != 0;
    add_algorithm(s, (batched ? t.name : std::string(robot.name)) + "." + s.name, {item});
    return d->kind == Kind::motion;
  }

  const Description* describe(const Subsystem& s) {
    try {
      return registry_.algorithm(s.use).description;
    } catch (const SetupError& e) {
      problems_.add(s.location, e.what());
      return nullptr;
    }
  }

  void add_algorithm(const Subsystem& s, const std::string& name, std::vector<Item> items) {
    const Description* d = describe(s);
    if (!d) return;
    AlgorithmSetup setup;
    setup.name = name;
    setup.use = s.use;
    setup.subsystem = s.name;
    setup.parameters = s.parameters;
    setup.items = std::move(items);
    setup.place = s.location.text();
    const std::filesystem::path file(s.location.line > 0 ? s.location.file : scenario_.file);
    setup.folder = std::filesystem::absolute(file).parent_path().string();
    setup.phase = std::llround(s.phase * 1e9);
    if (s.rate)
      setup.rate = Rate(*s.rate);
    else if (const auto rate = default_rate(d->kind); rate && !s.on_demand)
      setup.rate = Rate(*rate);
    else if (!s.on_demand)
      problems_.add(s.location, "`" + s.name + "` needs a `rate` in Hz: how often `" + s.use + "` runs");
    used_.insert(s.use);
    added_[name].push_back(simulation_.add(std::move(setup)));
  }

  void add_kinematics() {
    Subsystem s;
    s.name = "kinematics";
    s.use = "kinematics.direct";
    s.location = {scenario_.file, 0, 0};
    for (const RobotView* r : world_.robots())
      if (r->frames.size() > 1) add_algorithm(s, "kinematics", {Item{r, r->base()}});
  }

  void add_defaults() {
    const auto involved = [&](const char* property, std::vector<std::string> Offer::*list) {
      return std::any_of(used_.begin(), used_.end(), [&](const std::string& id) {
        const auto& names = registry_.find(id).*list;
        return std::find(names.begin(), names.end(), property) != names.end();
      });
    };
    for (const Default& d : defaults) {
      const auto& off = scenario_.switched_off;
      if (std::find(off.begin(), off.end(), d.name) != off.end()) continue;
      if (!involved(d.property, &Offer::reads) || involved(d.property, &Offer::writes)) continue;
      Subsystem s;
      s.name = d.name;
      s.use = d.use;
      s.location = {scenario_.file, 0, 0};
      add_algorithm(s, d.name, {});
    }
  }

  void add_sequence(std::size_t i) {
    std::vector<std::size_t> algorithms;
    for (const std::string& name : scenario_.sequences[i]) {
      const auto known = added_.find(name);
      if (known != added_.end()) {
        algorithms.insert(algorithms.end(), known->second.begin(), known->second.end());
        continue;
      }
      std::vector<std::string> names;
      for (const auto& [n, unused] : added_) names.push_back(n);
      problems_.add(scenario_.sequence_locations[i], "no algorithm is named `" + name + "`" + did_you_mean(name, names));
    }
    if (algorithms.size() > 1) simulation_.add_sequence(std::move(algorithms));
  }

  BuiltScenario& out_;
  Scenario& scenario_;
  Registry& registry_;
  Simulation& simulation_;
  World& world_;
  Problems problems_;
  std::vector<Obstacle> obstacles_;
  std::vector<Footprint> footprints_;
  std::set<std::string> used_;
  std::map<std::string, std::vector<std::size_t>> added_;
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
