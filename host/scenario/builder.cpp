// SPDX-License-Identifier: MIT
#include "host/scenario/builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <thread>

#include "core/output_registry.hpp"
#include "host/names.hpp"
#include "host/process/exit_guard.hpp"
#include "host/process/out_of_memory.hpp"
#include "host/scenario/algorithms.hpp"
#include "host/scenario/body.hpp"
#include "host/scenario/initial_state.hpp"
#include "host/scenario/joint_dynamics.hpp"
#include "host/scenario/materials.hpp"
#include "host/scenario/model_drives.hpp"
#include "host/scenario/model_subsystems.hpp"
#include "host/scenario/overlaps.hpp"
#include "host/scenario/place_properties.hpp"
#include "host/scenario/placement.hpp"
#include "host/scenario/shadow_robot.hpp"
#include "host/scenario/shape_files.hpp"
#include "host/scenario/subsystems.hpp"
#include "host/scenario/terrain.hpp"
#include "host/scenario/unreadable_meshes.hpp"
#include "host/scenario/world_file.hpp"
#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

class SceneBuilder {
 public:
  SceneBuilder(BuiltScenario& out, Registry& registry, ShapeFiles& files)
      : out_(out),
        scenario_(out.scenario),
        simulation_(*out.simulation),
        world_(simulation_.world()),
        algorithms_(out.scenario, registry, simulation_, problems_),
        subsystems_(simulation_, algorithms_, problems_),
        meshes_(files.meshes),
        unreadable_meshes_(meshes_, out),
        terrain_(files),
        world_file_(out, meshes_, unreadable_meshes_, problems_) {}

  void build() {
    world_file_.read();
    world_.set(world_object, keys::gravity, world_file_.gravity());
    world_.set(world_object, keys::friction_rule, std::uint32_t(world_file_.friction_rule()));
    set_places(world_, scenario_);
    world_file_.add_scenery(occupied_);
    find_terrain();
    for (const SceneryObject& o : scenario_.objects) problems_.collect("", [&] { add_object(o); });
    add_all_robots();
    unreadable_meshes_.tell();
    algorithms_.complete();
    problems_.check();
  }

 private:
  static bool is_ground(const SceneryObject& o) {
    return o.shape.kind == ShapeKind::plane || o.shape.kind == ShapeKind::heightmap;
  }

  static std::size_t count_of(const Placement& p) {
    return p.kind == Placement::Kind::grid ? std::size_t(p.columns) * std::size_t(p.rows) : p.poses.size();
  }

  /// Finds the surfaces on which all other objects stand, in any order: first those without ground, then floors.
  void find_terrain() {
    terrain_.add_scenery(world_);
    for (const bool floors : {false, true})
      for (const SceneryObject& o : scenario_.objects)
        if (Terrain::carries(o.shape) && is_ground(o) != floors) add_terrain(o);
  }

  void add_terrain(const SceneryObject& o) {
    const bool is_readable = problems_.collect(fmt::format("{}: object `{}`: ", o.location.text(), o.name), [&] {
      if (o.shape.kind == ShapeKind::heightmap) terrain_.check_file(o.shape, o.mesh);
    });
    if (!is_readable) return;
    Occupancy unused;
    try {
      std::vector<Pose>& poses = poses_of_terrain_[&o];
      poses = place(o.placement, int(count_of(o.placement)), body_of(o, 0), scenario_.places, unused);
      for (const Pose& pose : poses) terrain_.add(o.shape, o.mesh, pose);
    } catch (const SetupError&) {  // reported when the object is added
      poses_of_terrain_.erase(&o);
    }
  }

  Body body_of(const SceneryObject& o, double radius) {
    if (is_ground(o)) return {o.name, {}, radius};
    return {o.name, standing_on_terrain({{o.shape, o.mesh, {}}}), radius};
  }

  /// Returns the height of a body with these shapes; must not be called after this object has ended.
  std::function<double(const Pose&)> standing_on_terrain(std::vector<StandingShape> shapes) {
    return [this, on = std::move(shapes)](const Pose& at) { return terrain_.height(on, at); };
  }

  void add_object(const SceneryObject& o) {
    const Placement& p = o.placement;
    Shape shape = o.shape;
    if (!o.mesh.empty()) shape.mesh = world_.intern(o.mesh);
    if (!o.texture.empty()) shape.texture = world_.intern(o.texture);
    const bool ground = is_ground(o);
    const Aabb box = ground || !needs_extent(p) ? Aabb{Vec3::Zero(), Vec3::Zero()}
                                                : meshes_.bounds_of(shape, o.mesh, {Vec3::Zero(), Quat::Identity()});
    const Vec3 half = 0.5 * (box.high - box.low), centre = 0.5 * (box.low + box.high);
    Occupancy unused;
    const auto known = poses_of_terrain_.find(&o);
    const std::vector<Pose> poses =
        known != poses_of_terrain_.end()
            ? known->second
            : place(p, int(count_of(p)), body_of(o, elementary::hypot(half.x(), half.y())), scenario_.places, unused);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      problems_.collect(o.location.text() + ": ", [&] {
        world_.add_scenery(instance_name(o.name, o.numbered, i), poses[i], std::span<const Shape>(&shape, 1));
      });
      if (!ground) occupied_.add(Obstacle{{poses[i] * centre, poses[i].orientation}, half.x(), half.y()});
    }
  }

  /// Refuses heightmaps of robots: their bodies move, and heightmaps do not.
  static void refuse_heightmaps(const RobotTree& tree) {
    if (const std::string link = link_with_heightmap(tree); !link.empty())
      throw SetupError(
          fmt::format("the link `{}` has a heightmap as a collision shape, which only scenery can have; put "
                      "`{{heightmap: file, size: [x, y, z]}}` into `world: objects` as the `shape` of an object",
                      link));
  }

  RobotTree model_of(const RobotTemplate& t) {
    RobotTree tree = read_model_of(t);
    refuse_heightmaps(tree);
    return tree;
  }

  RobotTree read_model_of(const RobotTemplate& t) {
    if (t.shape) return single_body(*t.shape, t.mesh, t.texture, inertia_of(t));
    RobotTree tree = t.from_world ? world_file_.model(t) : simulation_.read_model(t.model);
    if (!t.from_world)  // messages about models of a world are reported already
      for (const auto& p : tree.problems()) out_.note(t.model, p);
    if (t.from_world)
      unreadable_meshes_.leave_out(tree, scenario_.world_file->path, t.name + ".");
    else
      unreadable_meshes_.leave_out(tree, t.model, "");
    return tree;
  }

  Inertia inertia_of(const RobotTemplate& t) {
    if (t.shape->kind != ShapeKind::mesh) return homogeneous_inertia(*t.shape, t.mass);
    const std::optional<Inertia> solid = meshes_.inertia_of(t.mesh);
    if (const std::string& problem = meshes_.problem_of(t.mesh); !problem.empty()) throw SetupError(problem);
    if (!solid)
      throw SetupError(fmt::format("mesh {} is flat and has no volume, so a mass gives it no inertia", t.mesh));
    return stretched_inertia(*solid, t.shape->size, t.mass);
  }

  /// Whether the extent of a body matters for this placement.
  bool needs_extent(const Placement& p) const {
    const auto has_random = [](const RobotTemplate& t) { return t.placement.kind == Placement::Kind::random; };
    return std::any_of(p.poses.begin(), p.poses.end(), [](const PoseInput& pose) { return !pose.z; }) ||
           std::any_of(scenario_.robots.begin(), scenario_.robots.end(), has_random);
  }

  RobotTree::CornersOfMesh corners_of_meshes(const Placement& p) {
    if (!needs_extent(p)) return {};
    return [this](const std::string& path) { return meshes_.of(path); };
  }

  /// Common data of the robots of a template, and their poses.
  struct Model {
    std::optional<RobotTree> tree;
    StartPose start;
    std::vector<Pose> poses;
  };

  void tell_of_clamped(const RobotTemplate& t, const StartPose& start) {
    if (start.clamped.empty()) return;
    out_.clamped.push_back(fmt::format(
        "{}: robot `{}`: {} cannot be at 0 and start{} at the nearest limit: {}; set `joints` of the robot to "
        "start elsewhere",
        t.location.text(), t.name, plural(start.clamped.size(), "joint"), start.clamped.size() == 1 ? "s" : "",
        comma_separated(start.clamped)));
  }

  /// Adds all robots. Those with given poses come first, so that random ones keep their distance to all of them.
  void add_all_robots() {
    std::vector<Model> models(scenario_.robots.size());
    for (const bool random : {false, true})
      for (std::size_t i = 0; i < models.size(); ++i) {
        RobotTemplate& t = scenario_.robots[i];
        Model& m = models[i];
        if ((t.placement.kind == Placement::Kind::random) != random) continue;
        if (!problems_.collect(fmt::format("{}: robot `{}`: ", t.location.text(), t.name),
                               [&] { m.tree = model_of(t); }))
          continue;
        set_joint_dynamics(*m.tree, t, problems_);
        set_materials(*m.tree, t.name, t.materials, problems_);
        m.start = start_pose(*m.tree, t, problems_);
        add_model_subsystems(t, *m.tree, t.from_world ? scenario_.world_file->path : t.model, algorithms_, problems_);
        add_model_drives(t, *m.tree, algorithms_);
        tell_of_clamped(t, m.start);
        m.poses = poses_of(t, m);
      }
    for (std::size_t i = 0; i < models.size(); ++i)
      if (models[i].tree) add_robots(scenario_.robots[i], models[i]);
    for (const ShadowSetup& s : shadows_) add_shadow(simulation_, algorithms_, s, problems_);
  }

  std::vector<Pose> poses_of(RobotTemplate& t, const Model& m) {
    const RobotTree::CornersOfMesh corners = corners_of_meshes(t.placement);
    const double radius = m.tree->footprint_radius(m.start.positions, corners);
    std::vector<Pose> poses;
    if (t.from_world) {
      poses = {world_file_.pose(t)};
      occupied_.add(Footprint{poses[0].position.x(), poses[0].position.y(), radius});
      return poses;
    }
    if (!t.placement.seed) t.placement.seed = scenario_.seed;
    if (t.placement.kind == Placement::Kind::random) {
      int& drawn = drawn_[{t.placement.area, *t.placement.seed}];
      t.placement.first_copy = drawn;
      drawn += t.count;
    }
    problems_.collect("", [&] {
      const Body body{t.name, standing_on_terrain(standing_shapes(*m.tree, m.start.positions)), radius};
      poses = place(t.placement, t.count, body, scenario_.places, occupied_);
    });
    return poses;
  }

  /// Trees that differ from that of the template by the materials of variants; the keys are lists of variants.
  using RecoloredTrees = std::map<std::vector<std::size_t>, RobotTree>;

  const RobotTree& tree_of_copy(std::size_t copy, const RobotTemplate& t, const Model& m, RecoloredTrees& recolored) {
    std::vector<std::size_t> variants;
    for (std::size_t v = 0; v < t.material_variants.size(); ++v)
      if (int(copy) >= t.material_variants[v].first && int(copy) <= t.material_variants[v].last) variants.push_back(v);
    if (variants.empty()) return *m.tree;
    const auto [entry, is_new] = recolored.try_emplace(variants, *m.tree);
    if (is_new)
      for (const std::size_t v : variants)
        set_materials(entry->second, t.name, t.material_variants[v].changes, problems_);
    return entry->second;
  }

  void add_robots(const RobotTemplate& t, const Model& m) {
    const std::vector<Pose>& poses = m.poses;
    RecoloredTrees recolored;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RobotView* added = nullptr;
      if (!problems_.collect(t.location.text() + ": ", [&] {
            const RobotTree& tree = tree_of_copy(i, t, m, recolored);
            added = &world_.add_robot(instance_name(t.name, t.numbered, i), tree, poses[i]);
          }))
        continue;
      const RobotView& robot = *added;
      set_initial_state(world_, t, robot, m.start);
      for (const Subsystem& s : t.subsystems[i])
        if (s.shadow) shadows_.push_back({&t, &*m.tree, &m.start, poses[i], &robot, s.shadow.get()});
      if (subsystems_.add(t, robot, t.subsystems[i])) continue;
      world_.set(robot.base(), keys::pose, poses[i]);  // a robot without a motion does not move
      world_.set(robot.base(), keys::twist, Twist{});
    }
  }

  BuiltScenario& out_;
  Scenario& scenario_;
  Simulation& simulation_;
  World& world_;
  Problems problems_;
  Algorithms algorithms_;
  Subsystems subsystems_;
  MeshCorners& meshes_;
  UnreadableMeshes unreadable_meshes_;
  Terrain terrain_;
  std::map<const SceneryObject*, std::vector<Pose>> poses_of_terrain_;
  WorldFileContents world_file_;
  Occupancy occupied_;
  std::map<std::pair<std::string, std::uint64_t>, int> drawn_;  ///< copies with random poses, by place and seed
  std::vector<ShadowSetup> shadows_;
};

/// Prints messages of algorithms.
void print_line(LogLevel level, std::string_view text) {
  if (level == LogLevel::debug) return;
  const char* const severity = level == LogLevel::error ? "error" : level == LogLevel::warning ? "warning" : "note";
  fmt::print(stderr, "{}: {}\n", severity, text);
}

/// Returns the location in the scenario that places the robot of a body; empty: there is none.
std::string place_of_robot(const BuiltScenario& built, const std::string& body) {
  const World& world = built.simulation->world();
  const ObjectId object = world.find_object(body);
  const RobotId robot = object == no_object ? no_robot : world.robot_of(object);
  std::size_t end = 0;
  for (const RobotTemplate& t : built.scenario.robots) {
    end += t.subsystems.size();
    if (index_of(robot) < end) return t.placement.location.text();
  }
  return "";
}

BuiltScenario built(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more) {
  BuiltScenario out;
  out.scenario = std::move(scenario);
  registry.choose(out.scenario.plugins);
  out.simulation = std::make_unique<Simulation>(registry, out.scenario.seed);
  out.simulation->set_log(print_line);
  out.simulation->set_packages(out.scenario.packages);
  for (const std::string& file : out.scenario.files)
    out.simulation->outputs().add_input(file, "a file of the scenario");
  const auto files = std::make_shared<ShapeFiles>(*out.simulation);
  SceneBuilder(out, registry, *files).build();
  if (add_more) add_more(*out.simulation);
  out.simulation->build();
  ExitGuard::renew();
  out.simulation->set_overlap_check([simulation = out.simulation.get(), files](const muro::Placement& p) {
    return overlap_of(*simulation, *files, p);
  });
  const auto place_of = [&](const std::string& body) { return place_of_robot(out, body); };
  for (std::string& note : overlap_notes(*out.simulation, *files, place_of)) out.notes.push_back(std::move(note));
  out.simulation->set_threads(out.scenario.threads > 0 ? out.scenario.threads : all_threads());
  return out;
}

}  // namespace

void BuiltScenario::note(const std::string& file, const RobotTree::Problem& problem) {
  const std::string at = Location{file, problem.line, problem.column}.text();
  notes.push_back(fmt::format("{}: {}: {}", at, problem.severity == Severity::note ? "note" : "warning", problem.text));
  if (problem.severity == Severity::lost_collision) lost_collisions.push_back(at + ": " + problem.text);
}

unsigned all_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

BuiltScenario build(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more) {
  const std::string file = scenario.file;
  try {
    return built(std::move(scenario), registry, add_more);
  } catch (const std::bad_alloc&) {
    throw SetupError(fmt::format("{}: {}", file, lack_of_memory));
  }
}

}  // namespace muro::host
