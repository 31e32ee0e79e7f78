// SPDX-License-Identifier: MIT
// The humanoid of examples/models/humanoid.urdf: moved by muro, and as a scene for the other engines.
#pragma once

#include "tests/bench/baselines/humanoids.hpp"
#include "tests/support/scene.hpp"

namespace muro::bench {

/// Open-loop exercise of the robots: they stand with bent knees, or squat once a second, each in its own phase.
enum class Exercise { standing, squatting };

/// Angles of a humanoid whose thighs are bent forward and whose trunk is upright, arms down.
class Squat {
 public:
  explicit Squat(const std::vector<HumanoidBody>& bodies);

  /// Returns the angle of the thighs, rad; `time` in ms.
  static double bend(Exercise exercise, std::size_t robot, int time);
  /// Sets the angles of all hinges, rad.
  void set(double bend, std::span<double> hinges) const;
  /// Returns the height of the trunk's frame above the ground, m.
  double height(double bend) const;
  std::size_t knee() const { return knees_.front(); }  ///< a hinge

 private:
  std::vector<std::size_t> back_, knees_;  ///< hinges of hips and ankles; hinges of knees
  std::vector<std::pair<std::size_t, double>> arms_;
  double upright_ = 0;  ///< m, of the trunk's frame with straight legs
  double leg_ = 0;      ///< m, from hip to ankle
};

/// Returns the model with the servos and rotors of Servo and without damping and friction of joints.
RobotTree humanoid_model(test::Scene& scene);

/// Returns robots on a grid, 0.7 m apart, in the pose in which they begin the exercise.
HumanoidScene humanoid_scene(std::size_t robots, Exercise exercise);

/// Returns humanoids that a motion of muro moves with its default parameters.
std::unique_ptr<Humanoids> muro_humanoids(const HumanoidScene& scene, const std::string& motion, unsigned threads);

}  // namespace muro::bench
