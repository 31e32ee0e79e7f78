// SPDX-License-Identifier: MIT
#include "host/unsupported_features/used_features.hpp"

#include <cmath>

#include "host/constants.hpp"
#include "muro/toolkit/mass_properties.hpp"

namespace muro::host {

namespace {

std::string counted(std::size_t n, const char* what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

bool is_finite(double limit) { return std::isfinite(limit); }
bool is_turned(const ParameterInput* value, const char* word) {
  if (!value) return false;
  if (const auto* on = std::get_if<bool>(value)) return *on;
  const auto* text = std::get_if<std::string>(value);
  return text && *text == word;
}

class Needs {
 public:
  Needs(const World& world, const RobotView& robot, const MotionUse& use) : world_(world), robot_(robot), use_(use) {
    for (const Link& f : robot.links) inertias_.push_back(constant(world, f.object, keys::inertial, Inertia{}));
    for (const Link& f : robot.links) is_joint_.push_back(f.joint != JointKind::fixed && f.mimic < 0);
  }

  std::vector<Need> all() {
    const Inertia whole = composite_inertia(robot_.links, inertias_, std::vector<double>(inertias_.size(), 0.0));
    add_if(whole.mass > 0, feature_forces);
    add_joints();
    const auto shifts = [&](std::size_t i) { return is_joint_[i] && moves_mass(i, whole); };
    const std::size_t shifting = count(shifts);
    add_if(shifting > (fixed() ? 1 : 0), feature_link_dynamics, counted(shifting, "joint"));  // they push each other
    add_if(!fixed() && is_uneven(whole), feature_gyroscopic);
    if (use_.contacts) add_shapes();
    add_if(fixed(), feature_fixed_base);
    add_if(is_turned(parameter("self_collision"), "true"), feature_self_collision);
    return std::move(needs_);
  }

 private:
  void add_if(bool needed, Features bit, std::string amount = "") {
    if (needed) needs_.push_back({bit, std::move(amount)});
  }
  /// Of frames for whose number `test` holds.
  template <class Test>
  std::size_t count(Test test) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) n += test(i) ? 1 : 0;
    return n;
  }
  /// Adds a need when there are joints for which `test` of the frame's number holds.
  template <class Test>
  void add_count(Features bit, Test test) {
    const std::size_t n = count(test);
    add_if(n > 0, bit, counted(n, "joint"));
  }
  const ParameterInput* parameter(const char* name) const {
    const auto given = use_.parameters.find(name);
    return given == use_.parameters.end() ? nullptr : &given->second;
  }
  bool fixed() const { return is_turned(parameter("base"), "fixed"); }

  bool is_written(const Link& f, const KeyInfo& key) const {
    const Slot* slot = world_.store().find(f.joint_object, key.name);
    return slot && slot->writer() != nullptr;
  }

  void add_joints() {
    const auto joint = [&](std::size_t i) { return bool(is_joint_[i]); };
    const auto with = [&](auto test) {
      return [this, test](std::size_t i) { return is_joint_[i] && test(robot_.links[i].limits); };
    };
    const auto written = [&](const KeyInfo& key) {
      return [this, &key](std::size_t i) { return is_joint_[i] && is_written(robot_.links[i], key); };
    };
    add_count(feature_joints, joint);
    add_count(feature_velocity_targets, written(keys::joint_velocity_target));
    add_count(feature_position_targets, written(keys::joint_position_target));
    add_count(feature_acceleration_targets, written(keys::joint_acceleration_target));
    add_count(feature_effort_targets, written(keys::joint_effort_target));
    add_count(feature_joint_limits,
              with([](const JointLimits& l) { return is_finite(l.lower) || is_finite(l.upper); }));
    add_count(feature_joint_speed_limits, with([](const JointLimits& l) { return is_finite(l.velocity); }));
    add_count(feature_joint_effort_limits, with([](const JointLimits& l) { return is_finite(l.effort); }));
    add_count(feature_joint_damping, with([](const JointLimits& l) { return l.damping > 0; }));
    add_count(feature_joint_friction, with([](const JointLimits& l) { return l.friction > 0; }));
    // kinematics moves those that the motion leaves alone
    add_count(feature_mimic_joints, [&](std::size_t i) {
      const Link& f = robot_.links[i];
      const Slot* slot = f.mimic < 0 ? nullptr : world_.store().find(f.joint_object, keys::joint_position.name);
      return slot && slot->used_as(usage::variable);
    });
  }

  /// Whether the mass of the robot changes its place with a joint; that of a wheel does not.
  bool moves_mass(std::size_t joint, const Inertia& whole) const {
    const double size = std::sqrt(whole.tensor().trace() / whole.mass);
    for (const double way : {1.0, -0.7}) {
      std::vector<double> positions(robot_.links.size(), 0.0);
      positions[joint] = robot_.links[joint].joint == JointKind::prismatic ? 0.1 * way : way;
      for (std::size_t i = 0; i < positions.size(); ++i)
        if (robot_.links[i].mimic == std::int32_t(joint))
          positions[i] = robot_.links[i].mimic_multiplier * positions[joint];
      const Inertia moved = composite_inertia(robot_.links, inertias_, positions);
      if ((moved.com - whole.com).norm() > margin * size ||
          (moved.tensor() - whole.tensor()).norm() > margin * whole.tensor().norm())
        return true;
    }
    return false;
  }
  static constexpr double margin = 1e-4;  ///< of the robot's size and inertia

  /// Whether it turns about another axis than that of its angular momentum, in general.
  static bool is_uneven(const Inertia& whole) {
    const Mat3 tensor = whole.tensor();
    return (tensor - tensor.trace() / 3 * Mat3::Identity()).norm() > 0.01 * tensor.norm();
  }

  void add_shapes() {
    std::size_t shapes = 0, meshes = 0, scenery_meshes = 0;
    bool rough = false, elastic = false;
    for (std::uint32_t i = 0; i < world_.object_count(); ++i) {
      const std::int32_t owner = world_.robot_of(ObjectId{i});
      if (owner >= 0 && owner != std::int32_t(robot_.number)) continue;
      for (const Shape& s : constants(world_, ObjectId{i}, keys::collision_shapes)) {
        const bool mesh = s.kind == ShapeKind::mesh;
        elastic = elastic || s.restitution > 0;
        if (owner < 0) {
          scenery_meshes += mesh;
          continue;
        }
        ++shapes;
        meshes += mesh;
        rough = rough || s.friction > 0;
      }
    }
    if (shapes == 0) return;
    add_if(true, feature_contact);
    add_if(rough, feature_friction);
    add_if(elastic, feature_restitution);
    if (!use_.own_contacts || meshes + scenery_meshes == 0)
      return;  // others find them, and say themselves what they can
    const std::string amount = (meshes > 0 ? std::to_string(meshes) + " of its own" : "") +
                               (meshes > 0 && scenery_meshes > 0 ? ", " : "") +
                               (scenery_meshes > 0 ? std::to_string(scenery_meshes) + " of the scenery" : "");
    add_if(true, feature_convex_meshes, amount);
    add_if(true, feature_concave_meshes, amount);
  }

  const World& world_;
  const RobotView& robot_;
  const MotionUse& use_;
  std::vector<Inertia> inertias_;  ///< one a frame
  std::vector<bool> is_joint_;     ///< one a frame: whether its joint has a motion of its own
  std::vector<Need> needs_;
};

}  // namespace

std::vector<Need> needs_of(const World& world, const RobotView& robot, const MotionUse& use) {
  return Needs(world, robot, use).all();
}

}  // namespace muro::host
