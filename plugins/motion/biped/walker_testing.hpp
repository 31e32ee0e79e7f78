// SPDX-License-Identifier: MIT
// Walkers for tests: a trunk at the height of its hips, and two legs whose feet have flat soles at their ankles.
#pragma once

#include "keys.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/scene.hpp"

namespace muro::biped::testing {

using Parameters = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

inline constexpr double leg_length = 0.3;     ///< m
inline constexpr double hip_spacing = 0.037;  ///< m: distance of each hip from the middle
inline constexpr double foot_length = 0.1;    ///< m: half of it is before the ankle

/// Returns a walker. Each leg has joints yaw (z), hip (y), lift (it shortens the leg, m), ankle (y); the base is
/// between the hips. `trunk`: collision shape of the trunk; `mesh`: file of a sole that replaces `soles`.
inline RobotTree walker(std::vector<Shape> soles, const Shape* trunk = nullptr, const std::string& mesh = "") {
  return test::tree_of([&](RobotBuilder& b) {
    if (!mesh.empty()) soles = {{.kind = ShapeKind::mesh, .mesh = b.intern(mesh), .size = Vec3::Ones()}};
    b.base("trunk");
    b.set(keys::inertial, test::solid_box(2, {0.1, 0.1, 0.2}));
    if (trunk) b.set_array(keys::collision_shapes, std::span<const Shape>(trunk, 1));
    for (const bool is_left : {true, false}) {
      const std::string side = is_left ? "left_" : "right_";
      if (is_left) b.fork();
      b.translation({0, is_left ? hip_spacing : -hip_spacing, 0});
      b.revolute(side + "yaw", Vec3::UnitZ(), {});
      b.body(side + "pelvis");
      b.revolute(side + "hip", Vec3::UnitY(), {});
      b.body(side + "thigh");
      b.translation({0, 0, -leg_length});
      b.prismatic(side + "lift", Vec3::UnitZ(), {});
      b.body(side + "shank");
      b.revolute(side + "ankle", Vec3::UnitY(), {});
      b.body(side + "foot");
      b.set(keys::inertial, test::solid_box(0.1, {0.1, 0.05, 0.02}));
      b.set_array(keys::collision_shapes, std::span<const Shape>(soles));
      if (is_left) b.end();
    }
    b.end();
  });
}
/// Returns a plate whose lower side is at the ankle.
inline Shape flat_sole() {
  Shape plate = Shape::box({foot_length, 0.05, 0.02});
  plate.origin.position.z() = 0.01;
  return plate;
}

/// One walker on a plane.
struct Walk : test::Scene {
  const RobotView& robot;

  explicit Walk(double rate, const Parameters& more = {}, const std::map<std::string, double>& start = {},
                const Pose& plane = {}, const std::vector<Shape>& soles = {flat_sole()}, const Pose& at = {},
                const std::string& mesh = "")
      : robot((add_ground(0.8, plane), add("r", walker(soles, nullptr, mesh), plane * at))) {
    for (const auto& [joint, position] : start)
      world().set(world().object("r/" + joint), keys::initial_joint_position, position);
    Parameters parameters{{"feet", Names{"left_foot", "right_foot"}}, {"joints", std::string("position")}};
    for (const auto& [name, value] : more) parameters[name] = value;
    use("motion.biped", rate, all_robots(), parameters);
    use_kinematics();
    build();
  }
  void set(const std::string& joint, double target) {
    world().value("r/" + joint, keys::joint_position_target) = target;
  }
  Pose& base() { return pose(robot); }
  const Pose& link(const std::string& name) {
    refresh();
    return world().value("r/" + name, keys::pose);
  }
  template <class T>
  T& stance(const Key<T>& key) {
    return world().value(robot.base(), key);
  }
  std::uint64_t footholds() { return stance(own::stance_footholds); }
  std::uint32_t contact(const std::string& foot) { return world().value("r/" + foot, keys::foot_contact); }
};

/// Legs of the compass walker: the trunk stays upright over the stance leg, whose angle from the normal of the plane
/// goes evenly from -a to a in `period`. The other leg, at the opposite angle, is shortened by up to `lift` on the way.
struct Compass {
  double a = 20 * M_PI / 180, period = 0.4, lift = 0.03;
  double toe_up = 0;  ///< rad: pitch of the foot of the swing leg when it comes down; it is 0 at the end of the stance

  /// Sets the targets at time `t` (s); the left foot stands first.
  void set(Walk& w, double t) const {
    const auto step = std::int64_t(std::floor(t / period + 1e-9));
    const double part = t / period - double(step), s = a * (2 * part - 1);
    const bool left_stands = step % 2 == 0;
    put(w, left_stands ? "left_" : "right_", s, 0, step == 0 ? 0 : -toe_up * (1 - part));
    put(w, left_stands ? "right_" : "left_", -s, lift * std::sin(M_PI * part), -toe_up * part);
  }
  std::map<std::string, double> start() const {
    return {{"left_hip", -a}, {"left_ankle", a}, {"right_hip", a}, {"right_ankle", -a}};
  }

 private:
  static void put(Walk& w, const std::string& leg, double angle, double shorter, double pitch) {
    w.set(leg + "hip", angle);
    w.set(leg + "lift", shorter);
    w.set(leg + "ankle", pitch - angle);
  }
};

}  // namespace muro::biped::testing
