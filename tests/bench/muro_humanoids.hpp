// SPDX-License-Identifier: MIT
// The humanoid of examples/models/humanoid.urdf: as muro moves it, and as a scene for the engines beside it.
#pragma once

#include "tests/bench/baselines/humanoids.hpp"
#include "tests/support/scene.hpp"

namespace muro::bench {

/// What the robots do, in open loop: they stand with bent knees, or squat once a second, each in its own phase.
enum class Exercise { standing, squatting };

/// Angles of a humanoid whose thighs are bent forward and whose trunk is upright, arms down.
class Squat {
 public:
  explicit Squat(const std::vector<HumanoidBody>& bodies);

  /// rad, of the thighs; `time` in ms.
  static double bend(Exercise exercise, std::size_t robot, int time);
  /// rad, of all hinges.
  void set(double bend, std::span<double> hinges) const;
  /// m, of the trunk's frame above the ground.
  double height(double bend) const;
  std::size_t knee() const { return knees_.front(); }  ///< a hinge

 private:
  std::vector<std::size_t> back_, knees_;  ///< hinges of hips and ankles, of knees
  std::vector<std::pair<std::size_t, double>> arms_;
  double upright_ = 0;  ///< m, of the trunk's frame with straight legs
  double leg_ = 0;      ///< m, from hip to ankle
};

/// The model with the servos and rotors of Servo and without damping and friction of joints.
RobotTree humanoid_model(test::Scene& scene);

/// So many on a grid, 0.7 m apart, in the pose in which they begin the exercise.
HumanoidScene humanoid_scene(std::size_t robots, Exercise exercise);

/// Moved by a motion of muro, with its usual parameters.
std::unique_ptr<Humanoids> muro_humanoids(const HumanoidScene& scene, const std::string& motion, unsigned threads);

}  // namespace muro::bench
