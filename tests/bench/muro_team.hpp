// SPDX-License-Identifier: MIT
// The teams and scanners of muro that benchmarks compare with other engines.
#pragma once

#include <atomic>
#include <thread>

#include "tests/bench/baselines/scanners.hpp"
#include "tests/bench/baselines/team.hpp"
#include "tests/support/scene.hpp"

namespace muro::bench {

/// Collision shape of wheels: cylinders as in the model, or balls, as in all baselines.
enum class Wheels { cylinders, balls };

/// The city as scenery, its vehicles as robots "0", "1", ... of examples/models/rover.urdf. The caller adds the motion.
struct CityScene : test::Scene {
  /// `joint_dynamics`: whether joints have the damping and friction of the model (<dynamics>). Baselines leave them
  /// out.
  explicit CityScene(const City& city, Wheels wheels = Wheels::cylinders, bool joint_dynamics = true);
  /// Adds a scanner at 10 Hz to every vehicle; returns the objects of the scanners.
  std::vector<ObjectId> add_lasers(const Pattern& pattern, double range, bool see_self,
                                   const std::string& method = "laser.raycast");
};

/// The motion that moves the vehicles, at one rate.
struct MotionSetup {
  std::string motion = "motion.simplified";
  int rate = 1000;  ///< steps/s
  std::map<std::string, ParameterInput> parameters{};
  bool contact = true;         ///< whether the contact algorithm is used
  bool joint_dynamics = true;  ///< see CityScene
};

/// The team of vehicles with full collision.
class MuroTeam final : public Team {
 public:
  MuroTeam(const City& city, int threads, Wheels wheels, const MotionSetup& motion, const Pattern* lasers = nullptr,
           const std::string& method = "laser.raycast");
  /// `lasers`: scanner of each vehicle, with a range of 5.6 m, or null. `rate`: steps/s.
  MuroTeam(const City& city, int threads, Wheels wheels, const Pattern* lasers = nullptr, int rate = 1000);

  void command(int vehicle, WheelSpeeds speeds) override;
  void run(int milliseconds) override { scene_.run_for(1e-3 * milliseconds); }
  Pose pose(int vehicle) const override { return *poses_[std::size_t(vehicle)]; }

 private:
  CityScene scene_;
  std::vector<const Pose*> poses_;
  std::vector<std::array<double*, 4>> targets_;  ///< joint.velocity.target of each wheel
};

/// Two independent teams, each on a thread of its own. They show what the machine can do with two programs at once, and
/// so the most that two threads can gain.
class TwoTeams final : public Team {
 public:
  explicit TwoTeams(const City& city);
  ~TwoTeams() override;

  void command(int vehicle, WheelSpeeds speeds) override;
  void run(int milliseconds) override;
  Pose pose(int vehicle) const override { return first_.pose(vehicle); }

 private:
  void serve();

  MuroTeam first_, second_;
  std::atomic<int> requested_{0}, done_{0};  ///< ms of the second team; negative: the end
  std::thread thread_;
};

/// The vehicles with laser.raycast on each; the caller sets their poses.
class MuroScanners final : public Scanners {
 public:
  MuroScanners(const City& city, const Pattern& pattern, double range, int threads);

  void scan(std::span<const Pose> poses, bool moved) override;
  double range(int vehicle, int ray) const override;

 private:
  CityScene scene_;
  std::vector<Pose*> poses_;
  std::vector<ObjectId> sensors_;
};

}  // namespace muro::bench
