// SPDX-License-Identifier: MIT
// Noise of odometry, compared with the theory of a random walk along the way. Systematic errors and arcs are tested in
// tests/conformance/sensor.
#include <gtest/gtest.h>

#include <cmath>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;

constexpr std::size_t vehicles = 600;
constexpr double turn_by_turn = 3e-4, turn_by_way = 2e-4, way_by_way = 1e-3, way_by_turn = 5e-4;

/// Deviations of poses, in the frame in which the run began.
struct Deviations {
  double along = 0, aside = 0, turn = 0;  ///< mean squares: m^2, m^2, rad^2
};

/// Vehicles that drive in the same way. Each has an odometry without noise, and two with noise, at 10 Hz and 100 Hz.
struct Fleet : test::Scene {
  explicit Fleet(std::uint64_t seed = 1) : Scene(seed) {
    const RobotTree rover = read_model(MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf");
    for (std::size_t i = 0; i < vehicles; ++i) {
      const RobotView& r = add("r" + std::to_string(i), rover);
      exact.push_back({&r, add_sensor_object(r, "exact", r.base())});
      slow.push_back({&r, add_sensor_object(r, "slow", r.base())});
      fast.push_back({&r, add_sensor_object(r, "fast", r.base())});
    }
    const Settings noise{{"alphas", std::vector<double>{turn_by_turn, turn_by_way, way_by_way, way_by_turn}}};
    use("motion.differential_drive", 100, all_robots());
    use("drive.skid_steer", 0, all_robots());
    use("sensor.odometry", 10, exact);
    use("sensor.odometry", 10, slow, noise);
    use("sensor.odometry", 100, fast, noise);
    build();
  }
  /// Drives for whole seconds, so that all readings belong to one instant.
  void drive(double speed, double yaw_rate, int seconds) {
    for (const Item& item : exact)
      world().value(item.robot->base(), keys::command_twist) = {{speed, 0, 0}, {0, 0, yaw_rate}};
    run_until(std::int64_t(seconds) * 1'000'000'000 + 1);
  }
  const Pose& of(const Item& item) { return world().value(item.object, keys::odometry_pose); }
  Deviations deviations(const std::vector<Item>& noisy) {
    Deviations d;
    for (std::size_t i = 0; i < vehicles; ++i) {
      const Pose &truth = of(exact[i]), &read = of(noisy[i]);
      const double turn = yaw_of(truth.orientation.conjugate() * read.orientation);
      d.along += std::pow(read.position.x() - truth.position.x(), 2) / double(vehicles);
      d.aside += std::pow(read.position.y() - truth.position.y(), 2) / double(vehicles);
      d.turn += turn * turn / double(vehicles);
    }
    return d;
  }
  std::vector<Item> exact, slow, fast;
};

const double within = 3 * std::sqrt(2.0 / double(vehicles));  // three standard deviations of a variance

TEST(OdometryNoise, GrowsWithTheWayWhateverTheRate) {
  Fleet f;
  f.drive(0.5, 0, 10);
  const double way = f.of(f.exact[0]).position.x();
  EXPECT_NEAR(way, 5, 0.5);
  for (const auto& noisy : {f.slow, f.fast}) {
    const Deviations d = f.deviations(noisy);
    EXPECT_NEAR(d.along / (way_by_way * way), 1, within);
    EXPECT_NEAR(d.turn / (turn_by_way * way), 1, within);
    EXPECT_NEAR(d.aside / (turn_by_way * way * way * way / 3), 1, within) << "the integral of a random walk";
  }
}

TEST(OdometryNoise, GrowsWithTheTurnWhateverTheRate) {
  Fleet f;
  f.drive(0, 0.3, 8);
  const double turn = yaw_of(f.of(f.exact[0]).orientation);
  EXPECT_NEAR(turn, 2.4, 0.3);
  for (const auto& noisy : {f.slow, f.fast}) {
    const Deviations d = f.deviations(noisy);
    EXPECT_NEAR(d.turn / (turn_by_turn * turn), 1, within);
    EXPECT_NEAR((d.along + d.aside) / (way_by_turn * turn), 1, within);
  }
}

TEST(OdometryNoise, IsThatOfTheSeedAndGoesOnFromASnapshot) {
  Fleet a(1), b(2);
  a.drive(0.5, 0.1, 1);
  b.drive(0.5, 0.1, 1);
  EXPECT_NE(a.of(a.fast[0]).position, b.of(b.fast[0]).position);
  EXPECT_NE(a.of(a.fast[0]).position, a.of(a.fast[1]).position) << "each vehicle has its own";
  const Snapshot middle = a.snapshot();
  a.run_for(0.5);
  const std::uint64_t end = a.state_hash();
  a.restore(middle);
  a.run_for(0.5);
  EXPECT_EQ(a.state_hash(), end);
}

TEST(OdometryNoise, IsNoneAtRest) {
  Fleet f;
  f.drive(0, 0, 1);
  EXPECT_EQ(f.of(f.fast[0]).position, Vec3(0, 0, 0));
}

}  // namespace
}  // namespace muro
