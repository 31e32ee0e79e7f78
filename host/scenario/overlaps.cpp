// SPDX-License-Identifier: MIT
#include "host/scenario/overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/instance.hpp"
#include "host/names.hpp"
#include "host/scenario/terrain_depth.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr double least_depth = 1e-3;  // m; smaller overlaps are normal in models and placement

/// The poses to check: those at the start, or the present ones, except for the body that is placed.
struct Moment {
  bool is_start = true;
  const muro::Placement* placed = nullptr;
};

Pose pose_of(const World& world, const RobotView& robot, const Moment& moment) {
  if (moment.is_start) return world.constant(robot.base(), keys::initial_pose, Pose{});
  if (moment.placed->object == robot.base()) return moment.placed->pose;
  return world.value(robot.base(), keys::pose, Pose{});
}

/// Returns the poses of all links in the frame of the base.
std::vector<Pose> link_poses(const World& world, const RobotView& robot, const Moment& moment) {
  const auto start = [&](const Link& link) {
    return moment.is_start ? world.constant(link.joint_object, keys::initial_joint_position, 0.0)
                           : world.value(link.joint_object, keys::joint_position, 0.0);
  };
  std::vector<Pose> poses(robot.links.size());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Link& link = robot.links[i];
    double position = 0;
    if (link.joint != JointKind::fixed)
      position = link.mimic < 0
                     ? start(link)
                     : link.mimic_offset + link.mimic_multiplier * start(robot.links[std::size_t(link.mimic)]);
    poses[i] = poses[std::size_t(link.parent)] * pose_in_parent(link, position);
  }
  return poses;
}

/// Whether contacts move or stop the robot.
bool heeds_contacts(const World& world, const RobotView& robot) {
  const std::uint64_t* const contact_world = world.find_value(robot.base(), keys::contact_world);
  return (contact_world && *contact_world != 0) || world.is_used(robot.base(), keys::contacts.name, usage::read);
}

/// A body of the still scene, the same in each variant of it.
struct ShapeOfBody {
  ObjectId object;     ///< the base of a robot, or scenery
  std::uint32_t link;  ///< for a robot, an index in Names
  auto operator<=>(const ShapeOfBody&) const = default;
};

struct PairContact {
  std::array<ShapeOfBody, 2> bodies;
  double depth;
};

/// Whether the motion of each robot takes meshes of scenery as their convex hulls. A world has a parameter `meshes` for
/// this, or always does so; for all others the collision algorithm decides, by its own parameter.
std::vector<bool> takes_hulls_of_scenery(const Simulation& simulation) {
  const auto is_convex = [](const Instance& instance, std::string_view name, bool otherwise,
                            const std::map<std::string, ParameterInput>& given) {
    const auto& parameters = instance.description().parameters;
    const auto known =
        std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
    if (known == parameters.end()) return otherwise;
    const auto value = given.find(std::string(name));
    const auto* text = value == given.end() ? nullptr : std::get_if<std::string>(&value->second);
    return (text ? std::string_view(*text) : known->default_text) == "convex";
  };
  bool by_collision = false;
  for (const auto& instance : simulation.instances())
    if (instance->description().kind == Kind::collision)
      by_collision = is_convex(*instance, "meshes", false, instance->setup().parameters);
  std::vector<bool> all(simulation.world().robots().size(), by_collision);
  for (const auto& instance : simulation.instances()) {
    if ((instance->description().capabilities & Capability::world) == 0) continue;
    const AlgorithmSetup& setup = instance->setup();
    for (std::size_t i = 0; i < setup.items.size(); ++i)
      if (setup.items[i].robot)
        all[index_of(setup.items[i].robot->id)] = is_convex(
            *instance, "meshes", true, setup.item_setups.empty() ? setup.parameters : setup.item_setups[i].parameters);
  }
  return all;
}

/// A scene of the same shapes in which nothing moves: each robot is one body.
class Still {
 public:
  /// `hulls`: meshes count as their convex hulls, and only pairs for which they do are found.
  Still(Simulation& simulation, ShapeFiles& files, bool hulls, const Moment& moment = {})
      : original_(simulation.world()),
        files_(files),
        moment_(moment),
        still_(simulation.registry()),
        world_(still_.world()),
        hulls_(hulls) {
    if (hulls) scenery_is_hulls_ = takes_hulls_of_scenery(simulation);
    still_.set_log([](LogLevel, std::string_view) {});
    for (std::uint32_t i = 1; i < original_.object_count(); ++i)
      if (original_.robot_of(ObjectId{i}) == no_robot) add_scenery(ObjectId{i});
    for (const RobotView* robot : original_.robots())
      if (original_.constants(robot->base(), keys::shadow_of).empty()) add_robot(*robot);
    use_collision();
  }
  bool has_meshes() const { return has_meshes_; }

  /// Returns overlaps with the names of the `most` deepest. `found`: contacts from another scene of the same bodies.
  Overlaps overlaps(std::size_t most, const std::vector<PairContact>& found) {
    Overlaps all;
    contacts_.insert(contacts_.end(), found.begin(), found.end());
    keep_deepest();
    all.count = contacts_.size();
    for (const PairContact& c : std::span(contacts_).first(std::min(most, contacts_.size())))
      all.deepest.push_back({name_of(c.bodies[0]), name_of(c.bodies[1]), c.depth});
    return all;
  }

  const std::vector<PairContact>& find() {
    if (!finds_contacts_) return contacts_;
    const Accessor reader = world_.store().add_accessor("the check of overlaps");
    for (const RobotView* robot : world_.robots())
      world_.store().bind(reader, robot->base(), keys::contacts, usage::read, Multiplicity::list, 0, nullptr);
    still_.build();
    still_.run_until(1);
    for (const RobotView* robot : world_.robots())
      for (const Contact& c : world_.values(robot->base(), keys::contacts)) add(c);
    return contacts_;
  }

 private:
  struct Names {
    bool heeds_contacts;
    bool heeds_heightmaps;  ///< false when no contact moves it: it then moves on or through them
    bool scenery_is_hulls;
    std::vector<std::string> of_link;  ///< of links with shapes
    std::vector<std::uint32_t> link_of_shape;
  };

  Shape with_own_texts(Shape shape) {
    shape.mesh = world_.intern(original_.text(shape.mesh));
    shape.texture = no_text;
    has_meshes_ = has_meshes_ || shape.kind == ShapeKind::mesh;
    return shape;
  }

  void add_scenery(ObjectId object) {
    std::vector<Shape> shapes;
    for (const Shape& s : original_.constants(object, keys::collision_shapes)) shapes.push_back(with_own_texts(s));
    const auto pose = original_.constants(object, keys::pose);
    if (shapes.empty() || pose.empty()) return;
    const ObjectId added =
        world_.add_scenery(original_.object_name(object), pose.front(), shapes, std::span<const Shape>());
    for (const Shape& s : shapes)
      if (s.kind == ShapeKind::heightmap)
        heightmaps_.push_back({files_.heightmaps.of(std::string(world_.text(s.mesh)), s.size),
                               (pose.front() * s.origin).inverse(), added});
  }

  /// Finds bodies below heightmaps, also those that are so deep that they touch no surface.
  void find_buried(ObjectId base, const Names& names, const Pose& start, std::span<const Shape> shapes,
                   const TextTable& texts) {
    for (const HeightmapAt& h : heightmaps_)
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Shape& s = shapes[i];
        const auto corners =
            s.kind == ShapeKind::mesh ? files_.meshes.of(std::string(texts[s.mesh])) : std::span<const Vec3>{};
        const double depth = depth_below(h.map, h.inverse * (start * s.origin), s, corners);
        if (names.heeds_heightmaps && depth >= least_depth)
          contacts_.push_back({{ShapeOfBody{base, names.link_of_shape[i]}, ShapeOfBody{h.object, 0}}, depth});
      }
  }

  void add_robot(const RobotView& robot) {
    const std::vector<Pose> poses = link_poses(original_, robot, moment_);
    RobotTree tree;
    const bool is_placed = moment_.placed && moment_.placed->object == robot.base();
    const bool heeds = moment_.placed ? is_placed : heeds_contacts(original_, robot);
    const bool heeds_heightmaps = heeds && heeds_contacts(original_, robot);
    Names names{heeds, heeds_heightmaps, hulls_ && scenery_is_hulls_[index_of(robot.id)], {}, {}};
    std::vector<Shape> shapes;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const std::span<const Shape> of_link = original_.constants(robot.links[i].object, keys::collision_shapes);
      for (Shape s : of_link) {
        has_meshes_ = has_meshes_ || s.kind == ShapeKind::mesh;
        s.origin = poses[i] * s.origin;
        s.mesh = tree.intern(original_.text(s.mesh));
        s.texture = no_text;
        shapes.push_back(s);
        names.link_of_shape.push_back(std::uint32_t(names.of_link.size()));
      }
      if (!of_link.empty()) names.of_link.push_back(original_.object_name(robot.links[i].object));
    }
    if (shapes.empty()) return;
    tree.base("body");
    tree.set_array<Shape>(keys::collision_shapes, shapes);
    tree.close();
    const Pose start = pose_of(original_, robot, moment_);
    const ObjectId base = world_.add_robot(robot.name, tree, start).base();
    world_.set(base, keys::pose, start);
    world_.set(base, keys::twist, Twist{});
    if (!hulls_) find_buried(base, names, start, shapes, tree.texts());
    robots_[base] = std::move(names);
  }

  void use_collision() {
    const auto& catalog = still_.registry().catalog();
    const auto is_there = [&](std::string_view id) {
      return std::any_of(catalog.begin(), catalog.end(), [&](const CatalogEntry& e) { return e.id == id; });
    };
    AlgorithmSetup collision;
    collision.use = "collision.native";
    collision.parameters["meshes"] = std::string(hulls_ ? "convex" : "exact");
    finds_contacts_ = is_there("scene.bvh") && is_there(collision.use) && !robots_.empty() && (has_meshes_ || !hulls_);
    if (!finds_contacts_) return;
    collision.rate = Rate(1);
    still_.use("scene.bvh", 0);
    still_.add(std::move(collision));
  }

  ShapeOfBody body_of(ObjectId object, std::uint32_t shape) const {
    const auto robot = robots_.find(object);
    return {object, robot == robots_.end() ? 0 : robot->second.link_of_shape[shape]};
  }
  const std::string& name_of(const ShapeOfBody& body) const {
    const auto robot = robots_.find(body.object);
    return robot == robots_.end() ? world_.object_name(body.object) : robot->second.of_link[body.link];
  }
  bool heeds(ObjectId object) const {
    const auto robot = robots_.find(object);
    return robot != robots_.end() && robot->second.heeds_contacts;
  }

  /// Adds a contact. A pair of robots is in the lists of both; scenery comes second.
  void add(const Contact& c) {
    if (c.depth < least_depth || (!heeds(c.self) && !heeds(c.other))) return;
    const bool on_heightmap =
        std::any_of(heightmaps_.begin(), heightmaps_.end(), [&](const HeightmapAt& h) { return h.object == c.other; });
    if (on_heightmap && !robots_.at(c.self).heeds_heightmaps) return;
    if (hulls_ && robots_.count(c.other) == 0 && !robots_.at(c.self).scenery_is_hulls) return;
    PairContact pair{{body_of(c.self, c.self_shape), body_of(c.other, c.other_shape)}, c.depth};
    if (robots_.count(c.other) > 0 && pair.bodies[1] < pair.bodies[0]) std::swap(pair.bodies[0], pair.bodies[1]);
    contacts_.push_back(pair);
  }

  /// Keeps one contact of each pair of bodies, with the deepest pair first.
  void keep_deepest() {
    const auto by_pair = [](const PairContact& a, const PairContact& b) {
      return a.bodies != b.bodies ? a.bodies < b.bodies : a.depth > b.depth;
    };
    std::sort(contacts_.begin(), contacts_.end(), by_pair);
    const auto same = [](const PairContact& a, const PairContact& b) { return a.bodies == b.bodies; };
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end(), same), contacts_.end());
    std::stable_sort(contacts_.begin(), contacts_.end(),
                     [](const PairContact& a, const PairContact& b) { return a.depth > b.depth; });
  }

  struct HeightmapAt {
    Heightmap map;
    Pose inverse;  ///< pose of the world in the frame of the map
    ObjectId object;
  };

  const World& original_;
  ShapeFiles& files_;
  const Moment moment_;
  Simulation still_;
  World& world_;
  std::map<ObjectId, Names> robots_;  ///< by base
  std::vector<HeightmapAt> heightmaps_;
  std::vector<PairContact> contacts_;
  bool hulls_;
  std::vector<bool> scenery_is_hulls_;  ///< by robot
  bool has_meshes_ = false;
  bool finds_contacts_ = false;
};

}  // namespace

Overlaps overlaps_at_start(Simulation& simulation, ShapeFiles& files, std::size_t most) {
  const auto robots = simulation.world().robots();
  if (std::none_of(robots.begin(), robots.end(),
                   [&](const RobotView* r) { return heeds_contacts(simulation.world(), *r); }))
    return {};
  try {
    Still exact(simulation, files, false);
    exact.find();
    if (!exact.has_meshes()) return exact.overlaps(most, {});
    return exact.overlaps(most, Still(simulation, files, true).find());
  } catch (const std::exception&) {  // overlaps that cannot be found are not reported
    return {};
  }
}

std::string overlap_of(Simulation& simulation, ShapeFiles& files, const muro::Placement& placement) {
  constexpr double most_depth = 5e-3;  // m; wheels and feet sink in by less where they stand
  const Moment moment{false, &placement};
  try {
    Still exact(simulation, files, false, moment);
    exact.find();
    const Overlaps all =
        exact.has_meshes() ? exact.overlaps(1, Still(simulation, files, true, moment).find()) : exact.overlaps(1, {});
    if (all.deepest.empty() || all.deepest.front().depth < most_depth) return "";
    const Overlap& deepest = all.deepest.front();
    const RobotId robot = simulation.world().robot_of(placement.object);
    const auto is_own = [&](const std::string& name) {
      const ObjectId object = simulation.world().find_object(name);
      return object != no_object && robot != no_robot && simulation.world().robot_of(object) == robot;
    };
    return fmt::format("{} by {:.2g} m", in_backquotes(is_own(deepest.first) ? deepest.second : deepest.first),
                       deepest.depth);
  } catch (const std::exception&) {  // overlaps that cannot be found are not reported
    return "";
  }
}

std::vector<std::string> overlap_notes(Simulation& simulation, ShapeFiles& files,
                                       const std::function<std::string(const std::string& body)>& place_of) {
  const Overlaps all = overlaps_at_start(simulation, files, 5);
  std::vector<std::string> notes;
  for (const Overlap& o : all.deepest) {
    const std::string place = place_of(o.first);
    notes.push_back(
        fmt::format("{}note: `{}` and `{}` overlap by {:.2g} m at the start; contacts push them apart, so move "
                    "one of them",
                    place.empty() ? "" : place + ": ", o.first, o.second, o.depth));
  }
  if (all.count > notes.size())
    notes.push_back(fmt::format("note: {} start in overlap", plural(all.count - notes.size(), "more pair")));
  return notes;
}

}  // namespace muro::host
