// SPDX-License-Identifier: MIT
#include "core/robot_tree.hpp"

#include <algorithm>
#include <cstring>

#include "muro/toolkit/bounds.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

namespace {

std::string in_quotes(std::string_view s) { return "`" + std::string(s) + "`"; }

}  // namespace

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
  if (name.empty()) report(Severity::error, "a body or joint without a name", 0, 0);
  const auto index = std::int32_t(components_.size());
  if (!component_index_.emplace(std::string(name), index).second)
    report(Severity::error,
           "two parts are named " + in_quotes(name) + "; names of bodies and joints are unique in a robot", 0, 0);
  components_.push_back({std::string(name), {}});
  last_component_ = index;
  return index;
}

void RobotTree::base(std::string_view name) noexcept {
  if (at_.link >= 0) return report(Severity::error, "a second base " + in_quotes(name) + "; a robot has one", 0, 0);
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
  if (!offset.allFinite()) return report(Severity::error, "a translation that is not finite", 0, 0);
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
    return report(Severity::error, "joint " + in_quotes(name) + ": the axis has no direction", 0, 0);
  add_node(kind, name);
  FlatLink f;
  f.joint = add_component(name);
  f.link.parent = at_.link;
  f.link.joint = kind == NodeKind::revolute ? JointKind::revolute : JointKind::prismatic;
  f.link.origin = at_.since;
  f.link.axis = axis / length;
  f.link.limits = limits;
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

TextId RobotTree::intern(std::string_view text) noexcept {
  const auto it = std::find(texts_.begin(), texts_.end(), text);
  if (it != texts_.end()) return TextId(it - texts_.begin());
  texts_.emplace_back(text);
  return TextId(texts_.size() - 1);
}

void RobotTree::set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept {
  if (last_component_ < 0)
    return report(Severity::error, "constant `" + std::string(key.name) + "` before base()", 0, 0);
  const auto* first = static_cast<const std::byte*>(data);
  const std::size_t bytes = std::size_t(count == single_value ? 1 : count) * key.type->size;
  components_[std::size_t(last_component_)].constants.push_back({key, count, {first, first + bytes}});
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
    const std::string name = in_quotes(components_[std::size_t(f.joint)].name);
    if (it == links_.end())
      report(Severity::error,
             "joint " + name + " mimics " + in_quotes(f.mimic_leader) + ", which is no joint of the robot", 0, 0);
    else if (!it->mimic_leader.empty())
      report(Severity::error,
             "joint " + name + " mimics " + in_quotes(f.mimic_leader) + ", which mimics a joint itself", 0, 0);
    else
      f.link.mimic = std::int32_t(it - links_.begin());
  }
}

bool RobotTree::usable() const {
  return std::none_of(problems_.begin(), problems_.end(),
                      [](const Problem& p) { return p.severity == Severity::error; });
}

template <class Visit>
void RobotTree::each_collision_bounds(Visit visit) const {
  std::vector<Pose> poses;
  for (const FlatLink& f : links_) {
    poses.push_back(f.link.parent < 0 ? Pose{} : poses[std::size_t(f.link.parent)] * f.link.origin);
    for (const Constant& c : components_[std::size_t(f.body)].constants) {
      if (c.key.name != keys::collision_shapes.name) continue;
      for (std::uint32_t i = 0; i < c.count; ++i) {
        Shape s;
        std::memcpy(static_cast<void*>(&s), c.data.data() + i * sizeof(Shape), sizeof(Shape));
        if (s.kind != ShapeKind::plane) visit(bounds_of(s, poses.back() * s.origin));
      }
    }
  }
}

double RobotTree::standing_height() const {
  double lowest = 0;
  bool any = false;
  each_collision_bounds([&](const Aabb& b) {
    lowest = any ? std::min(lowest, b.low.z()) : b.low.z();
    any = true;
  });
  return -lowest;
}

double RobotTree::footprint_radius() const {
  double radius = 0;
  each_collision_bounds([&](const Aabb& b) {
    const Vec3 far = b.low.cwiseAbs().cwiseMax(b.high.cwiseAbs());
    radius = std::max(radius, std::hypot(far.x(), far.y()));
  });
  return radius;
}

}  // namespace muro
