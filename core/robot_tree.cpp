// SPDX-License-Identifier: MIT
#include "core/robot_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <set>

#include "core/error.hpp"
#include "core/extent_along.hpp"
#include "core/own_values.hpp"
#include "core/point_bounds.hpp"
#include "core/value_check.hpp"
#include "muro/base/bounds.hpp"
#include "muro/base/elementary.hpp"
#include "muro/base/limits.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"

namespace muro {

bool RobotTree::started(std::string_view call) {
  if (at_.link >= 0 && !at_.closed) return true;
  if (at_.closed) {
    report(
        Severity::error,
        std::string(call) + " behind a fork whose two branches are closed: a fork is binary, open another in a branch",
        0, 0);
    return false;
  }
  report(Severity::error, std::string(call) + " before base(): a robot's tree begins with its base", 0, 0);
  return false;
}

void RobotTree::report(Severity severity, std::string_view text, int line, int column) noexcept {
  problems_.push_back({severity, std::string(text), line, column});
}

void RobotTree::add_node(NodeKind kind, std::string_view name) {
  nodes_.push_back({kind, std::string(name), at_.node});
  at_.node = std::int32_t(nodes_.size()) - 1;
}

std::int32_t RobotTree::add_component(std::string_view name) {
  try {
    check_object_name(name, "a body or joint");
  } catch (const SetupError& e) {
    report(Severity::error, e.what(), 0, 0);
  }
  const auto index = std::int32_t(components_.size());
  if (!component_index_.emplace(std::string(name), index).second)
    report(Severity::error,
           "two parts are named " + in_backquotes(name) + "; names of bodies and joints are unique in a robot", 0, 0);
  components_.push_back({std::string(name), {}, {}});
  last_component_ = index;
  return index;
}

void RobotTree::base(std::string_view name) noexcept {
  if (at_.link >= 0) return report(Severity::error, "a second base " + in_backquotes(name) + "; a robot has one", 0, 0);
  add_node(NodeKind::base, name);
  FlatLink f;
  f.body = add_component(name);
  links_.push_back(std::move(f));
  at_.link = 0;
}

void RobotTree::fork() noexcept {
  if (!started("fork()")) return;
  add_node(NodeKind::fork, "");
  forks_.push_back(at_);
  forks_.back().branches = 0;
}

void RobotTree::end() noexcept {
  if (forks_.empty()) return report(Severity::error, "end() without a fork() that is open", 0, 0);
  Cursor& fork = forks_.back();
  at_ = fork;
  if (++fork.branches < 2) return;
  at_.closed = true;
  forks_.pop_back();
}

void RobotTree::translation(const Vec3& offset) noexcept {
  if (!started("translation()")) return;
  if (!limits::within(limits::position, offset))
    return report(Severity::error, "a translation with a component that is not from -1e8 to 1e8 m", 0, 0);
  add_node(NodeKind::translation, "");
  at_.since = at_.since * Pose{offset, Quat::Identity()};
  at_.unnamed = false;
}

void RobotTree::rotation(const Quat& turn) noexcept {
  if (!started("rotation()")) return;
  if (!turn.coeffs().allFinite() || turn.norm() < 1e-9)
    return report(Severity::error, "a rotation that is no unit quaternion", 0, 0);
  add_node(NodeKind::rotation, "");
  at_.since = at_.since * Pose{Vec3::Zero(), turn.normalized()};
  at_.unnamed = false;
}

void RobotTree::joint(NodeKind kind, std::string_view name, const Vec3& axis, const JointLimits& limits) {
  if (!started("a joint")) return;
  const double length = axis.norm();
  if (!(length > 1e-12) || !axis.allFinite())
    return report(Severity::error, "joint " + in_backquotes(name) + ": the axis has no direction", 0, 0);
  if (const std::string problem = limits::problem_of(limits); !problem.empty())
    return report(Severity::error, "joint " + in_backquotes(name) + " " + problem, 0, 0);
  add_node(kind, name);
  FlatLink f;
  f.joint = add_component(name);
  f.link.parent = at_.link;
  f.link.joint = kind == NodeKind::revolute ? JointKind::revolute : JointKind::prismatic;
  f.link.origin = at_.since;
  f.link.axis = axis / length;
  f.link.limits = limits::effective(limits);
  links_.push_back(std::move(f));
  at_.link = std::int32_t(links_.size()) - 1;
  at_.since = {};
  at_.unnamed = true;
}

void RobotTree::revolute(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept {
  joint(NodeKind::revolute, name, axis, limits);
}

void RobotTree::prismatic(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept {
  joint(NodeKind::prismatic, name, axis, limits);
}

void RobotTree::mimic(std::string_view leader, double multiplier, double offset) noexcept {
  if (!started("mimic()")) return;
  FlatLink& f = links_.back();
  if (f.joint < 0 || f.joint != last_component_)
    return report(Severity::error, "mimic(" + std::string(leader) + ") does not follow a joint", 0, 0);
  if (!limits::within(limits::joint_position, multiplier) || !limits::within(limits::joint_position, offset))
    return report(Severity::error,
                  fmt::format("joint {} mimics {} with a multiplier or offset that is not from -1e6 to 1e6",
                              in_backquotes(components_[std::size_t(f.joint)].name), in_backquotes(leader)),
                  0, 0);
  f.mimic_leader = leader;
  f.link.mimic_multiplier = multiplier;
  f.link.mimic_offset = offset;
}

void RobotTree::body(std::string_view name) noexcept {
  if (!started("body()")) return;
  add_node(NodeKind::body, name);
  if (at_.unnamed && links_[std::size_t(at_.link)].body < 0) {
    links_[std::size_t(at_.link)].body = add_component(name);
  } else {
    FlatLink f;
    f.body = add_component(name);
    f.link.parent = at_.link;
    f.link.origin = at_.since;
    links_.push_back(std::move(f));
    at_.link = std::int32_t(links_.size()) - 1;
    at_.since = {};
  }
  at_.unnamed = false;
}

TextId RobotTree::intern(std::string_view text) noexcept { return texts_.intern(text); }

void* RobotTree::find_extension(const ExtensionId& id) noexcept {
  return id == PackageFolders::id() ? static_cast<PackageFolders*>(this) : nullptr;
}

void RobotTree::set_raw(const KeyInfo& given, const void* given_data, std::uint32_t count) noexcept {
  if (last_component_ < 0)
    return report(Severity::error, "constant `" + std::string(given.name) + "` before base()", 0, 0);
  const std::uint32_t elements = count == single_value ? 1 : count;
  const OwnValues own(given, given_data, elements);
  const KeyInfo& key = own.key();
  const void* const data = own.data();
  if (const std::string problem = problem_of_values(key, data, elements); !problem.empty())
    return report(
        Severity::error,
        fmt::format("`{}` of {} {}", key.name, in_backquotes(components_[std::size_t(last_component_)].name), problem),
        0, 0);
  if (key.name == keys::visual_materials.name) return take_materials({static_cast<const TextId*>(data), elements});
  if (key.name == keys::model_subsystems.name) return take_subsystems({static_cast<const TextId*>(data), elements});
  if (key.name == keys::model_subsystem_places.name) {
    const auto* const places = static_cast<const std::int32_t*>(data);
    for (std::size_t i = 0; i < std::min<std::size_t>(subsystems_.size(), elements / 2); ++i)
      subsystems_[i].line = places[2 * i], subsystems_[i].column = places[2 * i + 1];
    return;
  }
  const auto* first = static_cast<const std::byte*>(data);
  const std::size_t bytes = std::size_t(elements) * key.type->size;
  components_[std::size_t(last_component_)].constants.push_back({key, count, {first, first + bytes}});
}

bool RobotTree::are_interned(std::span<const TextId> ids, const char* what) {
  const auto is_known = [&](TextId id) { return std::size_t(id) < texts_.size(); };
  if (std::all_of(ids.begin(), ids.end(), is_known)) return true;
  report(Severity::error, fmt::format("{} are not interned with the robot that has them", what), 0, 0);
  return false;
}

void RobotTree::take_materials(std::span<const TextId> names) {
  if (are_interned(names, "names of materials"))
    components_[std::size_t(last_component_)].visual_materials.assign(names.begin(), names.end());
}

void RobotTree::take_subsystems(std::span<const TextId> texts) {
  if (!are_interned(texts, "subsystems")) return;
  subsystems_.clear();
  for (const TextId text : texts) subsystems_.push_back({std::string(texts_[text])});
}

void RobotTree::close() {
  if (links_.empty()) return report(Severity::error, "the model has no base", 0, 0);
  if (!forks_.empty()) report(Severity::error, std::to_string(forks_.size()) + " fork() without two end()", 0, 0);
  for (FlatLink& f : links_) {
    if (f.body < 0) f.body = add_component(components_[std::size_t(f.joint)].name + "_frame");
    if (f.mimic_leader.empty()) continue;
    const auto it = std::find_if(links_.begin(), links_.end(), [&](const FlatLink& g) {
      return g.joint >= 0 && components_[std::size_t(g.joint)].name == f.mimic_leader;
    });
    const std::string name = in_backquotes(components_[std::size_t(f.joint)].name);
    if (it == links_.end())
      report(Severity::error,
             "joint " + name + " mimics " + in_backquotes(f.mimic_leader) + ", which is no joint of the robot", 0, 0);
    else if (!it->mimic_leader.empty())
      report(Severity::error,
             "joint " + name + " mimics " + in_backquotes(f.mimic_leader) + ", which mimics a joint itself", 0, 0);
    else
      f.link.mimic = std::int32_t(it - links_.begin());
  }
  check_mass();
}

/// Reports a robot with less than the least mass of a body: any force would give it an infinite acceleration.
void RobotTree::check_mass() {
  double mass = 0;
  for (const Component& component : components_)
    for (const Constant& c : component.constants)
      if (c.key.name == keys::inertial.name && c.data.size() >= sizeof(Inertia)) {
        Inertia inertia;
        std::memcpy(static_cast<void*>(&inertia), c.data.data(), sizeof inertia);
        mass += inertia.mass;
      }
  if (mass != 0 && !(mass >= limits::min_mass && mass <= limits::max_mass))
    report(Severity::error, fmt::format("all its bodies together have {} kg; 0, or 1e-9 to 1e9 kg are possible", mass),
           0, 0);
}

bool RobotTree::usable() const {
  return std::none_of(problems_.begin(), problems_.end(),
                      [](const Problem& p) { return p.severity == Severity::error; });
}

template <class Visit>
void RobotTree::each_collision_shape(std::span<const double> positions, const CornersOfMesh& corners_of_mesh,
                                     Visit visit) const {
  std::vector<Pose> poses;
  for (const FlatLink& f : links_) {
    const double position = positions.empty() ? 0 : positions[poses.size()];
    poses.push_back(f.link.parent < 0 ? Pose{} : poses[std::size_t(f.link.parent)] * pose_in_parent(f.link, position));
    for (const Constant& c : components_[std::size_t(f.body)].constants) {
      if (c.key.name != keys::collision_shapes.name) continue;
      for (std::uint32_t i = 0; i < c.count; ++i) {
        Shape s;
        std::memcpy(static_cast<void*>(&s), c.data.data() + i * sizeof(Shape), sizeof(Shape));
        const bool is_mesh = s.kind == ShapeKind::mesh && corners_of_mesh;
        if (s.kind != ShapeKind::plane)
          visit(s, poses.back() * s.origin,
                is_mesh ? corners_of_mesh(std::string(texts_[s.mesh])) : std::span<const Vec3>());
      }
    }
  }
}

double RobotTree::standing_height(std::span<const double> positions, const CornersOfMesh& corners_of_mesh) const {
  std::optional<double> most;
  each_collision_shape(positions, corners_of_mesh,
                       [&](const Shape& s, const Pose& pose, std::span<const Vec3> corners) {
                         const double below = extent_along(s, corners, pose, -Vec3::UnitZ());
                         most = most ? std::max(*most, below) : below;
                       });
  return most.value_or(0);
}

void RobotTree::set_limits(std::size_t link, const JointLimits& limits) {
  assert(links_[link].joint >= 0 && limits::problem_of(limits).empty());
  links_[link].link.limits = limits;
}

std::vector<std::string> RobotTree::material_names() const {
  std::set<std::string> names;
  for (const Component& component : components_)
    for (const TextId name : component.visual_materials)
      if (name != no_text) names.insert(texts_[name]);
  return {names.begin(), names.end()};
}

bool RobotTree::set_material(std::string_view name, const Material& material) {
  const auto replace = [&](std::byte* place) {
    Shape shape;
    std::memcpy(static_cast<void*>(&shape), place, sizeof shape);
    if (shape.material_source == MaterialSource::file) shape.color.setOnes();  // white under a picture
    shape.material_source = MaterialSource::model;
    shape.color = material.color.value_or(shape.color);
    if (!material.texture.empty()) shape.texture = texts_.intern(material.texture);
    std::memcpy(place, static_cast<const void*>(&shape), sizeof shape);
  };
  bool found = false;
  for (Component& component : components_)
    for (Constant& c : component.constants) {
      if (c.key.name != keys::visual_shapes.name) continue;
      for (std::size_t i = 0; i < std::min<std::size_t>(c.count, component.visual_materials.size()); ++i) {
        const TextId material_name = component.visual_materials[i];
        if (material_name == no_text || texts_[material_name] != name) continue;
        replace(c.data.data() + i * sizeof(Shape));
        found = true;
      }
    }
  return found;
}

void RobotTree::remove_collision_shapes(
    const std::function<bool(const std::string& body, const Shape& shape)>& is_lost) {
  for (Component& component : components_)
    std::erase_if(component.constants, [&](Constant& c) {
      if (c.key.name != keys::collision_shapes.name) return false;
      std::vector<Shape> shapes(c.count);
      std::memcpy(static_cast<void*>(shapes.data()), c.data.data(), c.data.size());
      std::erase_if(shapes, [&](const Shape& shape) { return is_lost(component.name, shape); });
      c.count = std::uint32_t(shapes.size());
      c.data.resize(shapes.size() * sizeof(Shape));
      std::memcpy(c.data.data(), static_cast<const void*>(shapes.data()), c.data.size());
      return shapes.empty();
    });
}

bool RobotTree::has_collision_meshes() const {
  bool any = false;
  each_collision_shape(
      {}, {}, [&](const Shape& s, const Pose&, std::span<const Vec3>) { any = any || s.kind == ShapeKind::mesh; });
  return any;
}

double RobotTree::footprint_radius(std::span<const double> positions, const CornersOfMesh& corners_of_mesh) const {
  double radius = 0;
  each_collision_shape(positions, corners_of_mesh,
                       [&](const Shape& s, const Pose& pose, std::span<const Vec3> corners) {
                         const Aabb b = corners.empty() ? bounds_of(s, pose) : bounds_of_points(corners, s.size, pose);
                         const Vec3 far = b.low.cwiseAbs().cwiseMax(b.high.cwiseAbs());
                         radius = std::max(radius, elementary::hypot(far.x(), far.y()));
                       });
  return radius;
}

}  // namespace muro
