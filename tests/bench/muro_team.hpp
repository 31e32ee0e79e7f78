// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/peers/team.hpp"
#include "tests/support/scene.hpp"

namespace muro::bench {

/// The city as scenery, its vehicles as robots "0", "1", ... of examples/models/rover.urdf. Motion is the caller's.
struct CityScene : test::Scene {
  explicit CityScene(const City& city);
};

/// The vehicles under motion.simplified with full collision, all at 1000 Hz.
class MuroTeam final : public Team {
 public:
  MuroTeam(const City& city, int threads);

  void command(int vehicle, WheelSpeeds speeds) override;
  void run(int steps) override { scene_.run_for(1e-3 * steps); }
  Vec3 position(int vehicle) const override { return poses_[std::size_t(vehicle)]->position; }

 private:
  CityScene scene_;
  std::vector<const Pose*> poses_;
  std::vector<std::array<double*, 4>> targets_;  ///< joint.velocity.target of each wheel
};

/// Uses so many threads; false when this build has no choice.
template <class Simulation_>
bool set_threads(Simulation_& simulation, int threads) {
  if constexpr (requires { simulation.set_threads(threads); }) {
    simulation.set_threads(threads);
    return true;
  } else {
    return threads == 1;
  }
}

}  // namespace muro::bench
