// SPDX-License-Identifier: MIT
// Humanoids with servos on level ground, the same for every engine.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "muro/geometry.hpp"
#include "muro/shape.hpp"

namespace muro::bench {

/// A body with the hinge that connects it to its parent. Links on fixed joints are part of their body.
struct HumanoidBody {
  std::string name;
  std::string joint;            ///< empty for the trunk, which is the first body
  int parent = -1;              ///< a smaller number than its own
  Pose origin{};                ///< in the parent's frame, with the hinge at 0
  Vec3 axis = Vec3::UnitX();    ///< unit, in the frame of the body
  double effort = 0;            ///< N m, limit of its servo
  Inertia inertia{};            ///< in the frame of the body, whose axes are principal
  std::vector<Shape> shapes{};  ///< boxes, balls and capsules
};

/// Each hinge has a servo: kp (target - q) - kd q', at most `effort`; and a rotor. No other damping or friction.
struct Servo {
  static constexpr double stiffness = 24.9;  ///< N m/rad
  static constexpr double damping = 0.68;    ///< N m s/rad
  static constexpr double armature = 0.012;  ///< kg m^2
};

/// Robots of one model on the plane z = 0.
struct HumanoidScene {
  std::vector<HumanoidBody> bodies;
  double friction = 0.8;     ///< of everything
  std::vector<Pose> starts;  ///< of the trunks
  std::vector<std::vector<double>>
      positions;  ///< rad, at the start: for each robot, of the hinge of each body but the trunk

  std::size_t robots() const { return starts.size(); }
  std::size_t hinges() const { return bodies.size() - 1; }
};

/// The robots in some engine, at 1000 steps a second. Nothing sleeps. Links of a robot pass through each other, robots
/// do not pass through one another.
class Humanoids {
 public:
  virtual ~Humanoids() = default;
  /// Sets the positions that the servos of a robot hold from now on: rad, one for each hinge.
  virtual void command(std::size_t robot, std::span<const double> targets) = 0;
  virtual void run(int milliseconds) = 0;
  virtual Pose trunk(std::size_t robot) const = 0;
  virtual double position(std::size_t robot, std::size_t hinge) const = 0;  ///< rad
};

/// Options of MuJoCo.
struct MujocoUse {
  const char* solver = "CG";
  const char* jacobian = "sparse";
  bool world_each = false;  ///< one world for each robot; otherwise one world for all
};
/// MuJoCo with 4 iterations and elliptic cones.
std::unique_ptr<Humanoids> mujoco_humanoids(const HumanoidScene& scene, const MujocoUse& use);

/// Bullet's btMultiBody with 4 iterations; `friction_directions`: 1 or 2.
std::unique_ptr<Humanoids> bullet_humanoids(const HumanoidScene& scene, int friction_directions);

}  // namespace muro::bench
