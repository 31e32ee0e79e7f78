// SPDX-License-Identifier: MIT
#include "host/scenario/features/used_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::host {

namespace {

std::string plural(std::size_t n, const char* noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

bool is_finite(double limit) { return std::isfinite(limit); }
/// Whether a parameter is true, or has the value `word`.
bool is_set_to(const ParameterInput* value, const char* word) {
  if (!value) return false;
  if (const auto* boolean = std::get_if<bool>(value)) return *boolean;
  const auto* text = std::get_if<std::string>(value);
  return text && *text == word;
}

class FeatureSearch {
 public:
  FeatureSearch(const World& world, const SceneryTraits& scenery, const RobotView& robot, const MotionUse& use)
      : world_(world), scenery_(scenery), robot_(robot), use_(use) {
    for (const Link& link : robot.links) {
      inertias_.push_back(world.constant(link.object, keys::inertial, Inertia{}));
      is_independent_joint_.push_back(link.joint != JointKind::fixed && link.mimic < 0);
    }
  }

  std::vector<UsedFeature> all() {
    const Inertia composite = composite_inertia(robot_.links, inertias_, std::vector<double>(inertias_.size(), 0.0));
    add_if(composite.mass > 0, feature_forces);
    add_joints();
    const std::size_t coupled =
        count_joints([&](std::size_t i) { return is_independent_joint_[i] && moves_mass(i, composite); });
    add_if(coupled > (has_fixed_base() ? 1 : 0), feature_link_dynamics, plural(coupled, "joint"));
    add_if(!has_fixed_base() && has_unequal_moments(composite), feature_gyroscopic);
    if (use_.contacts) add_shapes();
    add_if(has_fixed_base(), feature_fixed_base);
    add_if(is_set_to(parameter("self_collision"), "true"), feature_self_collision);
    return std::move(used_);
  }

 private:
  void add_if(bool used, Features bit, std::string amount = "") {
    if (used) used_.push_back({bit, std::move(amount)});
  }
  /// Number of links whose index passes `test`.
  template <class Test>
  std::size_t count_joints(Test test) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < robot_.links.size(); ++i) n += test(i) ? 1 : 0;
    return n;
  }
  /// Adds a feature when there are joints of links whose index passes `test`.
  template <class Test>
  void add_for_joints(Features bit, Test test) {
    const std::size_t n = count_joints(test);
    add_if(n > 0, bit, plural(n, "joint"));
  }
  const ParameterInput* parameter(const char* name) const {
    const auto given = use_.parameters.find(name);
    return given == use_.parameters.end() ? nullptr : &given->second;
  }
  bool has_mass() const {
    return std::any_of(inertias_.begin(), inertias_.end(), [](const Inertia& i) { return i.mass > 0; });
  }
  bool has_fixed_base() const { return is_set_to(parameter("base"), "fixed"); }

  bool is_written(const Link& link, const KeyInfo& key) const { return world_.is_written(link.joint_object, key.name); }

  void add_joints() {
    const auto any_joint = [&](std::size_t i) { return bool(is_independent_joint_[i]); };
    const auto with_limits = [&](auto test) {
      return [this, test](std::size_t i) { return is_independent_joint_[i] && test(robot_.links[i].limits); };
    };
    const auto written = [&](const KeyInfo& key) {
      return [this, &key](std::size_t i) { return is_independent_joint_[i] && is_written(robot_.links[i], key); };
    };
    add_for_joints(feature_joints, any_joint);
    add_for_joints(feature_velocity_targets, written(keys::joint_velocity_target));
    add_for_joints(feature_position_targets, written(keys::joint_position_target));
    add_for_joints(feature_acceleration_targets, written(keys::joint_acceleration_target));
    add_for_joints(feature_effort_targets, written(keys::joint_effort_target));
    add_for_joints(feature_joint_limits,
                   with_limits([](const JointLimits& l) { return is_finite(l.lower) || is_finite(l.upper); }));
    add_for_joints(feature_joint_speed_limits, with_limits([](const JointLimits& l) { return is_finite(l.velocity); }));
    if (has_mass()) {  // otherwise no effort moves a joint, with any limits and losses
      add_for_joints(feature_joint_effort_limits,
                     with_limits([](const JointLimits& l) { return is_finite(l.effort); }));
      add_for_joints(feature_joint_damping, with_limits([](const JointLimits& l) { return l.damping > 0; }));
      add_for_joints(feature_joint_friction, with_limits([](const JointLimits& l) { return l.friction > 0; }));
      add_for_joints(feature_armature, with_limits([](const JointLimits& l) { return l.armature > 0; }));
    }
    // a mimic joint is moved by kinematics when its position is no variable of the motion
    add_for_joints(feature_mimic_joints, [&](std::size_t i) {
      const Link& link = robot_.links[i];
      return link.mimic >= 0 && world_.is_used(link.joint_object, keys::joint_position.name, usage::variable);
    });
  }

  /// Whether the joint changes the robot's centre of mass or inertia; the joint of a balanced wheel does not.
  bool moves_mass(std::size_t joint, const Inertia& composite) const {
    const double size = std::sqrt(composite.tensor().trace() / composite.mass);
    for (const double displacement : {1.0, -0.7}) {
      std::vector<double> positions(robot_.links.size(), 0.0);
      positions[joint] = robot_.links[joint].joint == JointKind::prismatic ? 0.1 * displacement : displacement;
      for (std::size_t i = 0; i < positions.size(); ++i)
        if (robot_.links[i].mimic == std::int32_t(joint))
          positions[i] = robot_.links[i].mimic_multiplier * positions[joint];
      const Inertia moved = composite_inertia(robot_.links, inertias_, positions);
      if ((moved.com - composite.com).norm() > tolerance * size ||
          (moved.tensor() - composite.tensor()).norm() > tolerance * composite.tensor().norm())
        return true;
    }
    return false;
  }
  static constexpr double tolerance = 1e-4;  ///< relative to the robot's size and inertia

  /// Whether the principal moments of inertia differ: then angular velocity and momentum are not parallel.
  static bool has_unequal_moments(const Inertia& composite) {
    const Mat3 tensor = composite.tensor();
    return (tensor - tensor.trace() / 3 * Mat3::Identity()).norm() > 0.01 * tensor.norm();
  }

  void add_shapes() {
    std::size_t shapes = 0, meshes = 0;
    bool has_friction = false, has_restitution = scenery_.surface.restitution > 0;
    bool rolls = scenery_.surface.rolling_resistance > 0, spins = scenery_.surface.spinning_resistance > 0;
    for (const ObjectId object : world_.objects_of(robot_))
      for (const Shape& s : world_.constants(object, keys::collision_shapes)) {
        ++shapes;
        meshes += s.kind == ShapeKind::mesh;
        has_friction = has_friction || s.surface.friction > 0;
        has_restitution = has_restitution || s.surface.restitution > 0;
        rolls = rolls || s.surface.rolling_resistance > 0;
        spins = spins || s.surface.spinning_resistance > 0;
      }
    if (shapes == 0) return;
    add_if(true, feature_contact);
    add_if(has_friction, feature_friction);
    add_if(has_restitution, feature_restitution);
    add_if(rolls, feature_rolling_resistance);
    add_if(spins, feature_spinning_resistance);
    if (!use_.own_contacts) return;  // otherwise collision detection checks its meshes and heightmaps
    add_if(scenery_.heightmaps > 0, feature_heightmaps, plural(scenery_.heightmaps, "heightmap"));
    if (meshes + scenery_.meshes == 0) return;
    const std::string own = meshes > 0 ? fmt::format("{} of its own", meshes) : "";
    const std::string others = scenery_.meshes > 0 ? fmt::format("{} of the scenery", scenery_.meshes) : "";
    const std::string amount = own + (own.empty() || others.empty() ? "" : ", ") + others;
    add_if(true, feature_convex_meshes, amount);
    add_if(true, feature_concave_meshes, amount);
  }

  const World& world_;
  const SceneryTraits& scenery_;
  const RobotView& robot_;
  const MotionUse& use_;
  std::vector<Inertia> inertias_;           ///< by link
  std::vector<bool> is_independent_joint_;  ///< by link: its joint is movable and mimics no other
  std::vector<UsedFeature> used_;
};

}  // namespace

SceneryTraits scenery_traits(const World& world) {
  SceneryTraits traits;
  for (std::uint32_t i = 0; i < world.object_count(); ++i)
    if (world.robot_of(ObjectId{i}) == no_robot)
      for (const Shape& s : world.constants(ObjectId{i}, keys::collision_shapes)) {
        traits.meshes += s.kind == ShapeKind::mesh;
        traits.heightmaps += s.kind == ShapeKind::heightmap;
        traits.surface = pair_surface(traits.surface, s.surface, FrictionRule::max);
      }
  return traits;
}

std::vector<UsedFeature> used_features(const World& world, const SceneryTraits& scenery, const RobotView& robot,
                                       const MotionUse& use) {
  return FeatureSearch(world, scenery, robot, use).all();
}

}  // namespace muro::host
