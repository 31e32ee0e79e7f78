// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "move.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::simplified {
namespace {

constexpr int joint_count = 7;

/// Four wheels, a joint with limits, a joint with an upper limit, and a joint that follows the fifth.
struct Vehicle {
  Pose pose;
  Twist twist;
  Wrench wrench, second;
  double position[joint_count], velocity[joint_count], target[joint_count];

  RobotState state() {
    return {lane::numbers(&pose), lane::numbers(&twist), lane::numbers(&wrench), position, velocity, target};
  }
  bool equals(const Vehicle& b) const {
    return std::memcmp(&pose, &b.pose, sizeof pose) == 0 && std::memcmp(&twist, &b.twist, sizeof twist) == 0 &&
           std::memcmp(position, b.position, sizeof position) == 0 &&
           std::memcmp(velocity, b.velocity, sizeof velocity) == 0;
  }
};

constexpr RigidMass vehicle_mass{
    0.2, {0.01, -0.02, 0.03}, {0.05, 0.001, 0, 0.001, 0.07, 0, 0, 0, 0.1}, {20, -0.3, 0, -0.3, 14, 0, 0, 0, 10}};

/// Returns the joints. `together`: whether the wheels are moved at once.
std::vector<Joint> joints(bool together) {
  std::vector<Joint> all(joint_count);
  for (std::ptrdiff_t k = 0; k < joint_count; ++k) all[std::size_t(k)].position = all[std::size_t(k)].velocity = k;
  for (std::ptrdiff_t k = 0; k < joint_count; ++k) all[std::size_t(k)].target = k;
  all[0].range = {.speed = 40, .acceleration = 100};
  all[1].range = {.speed = 1, .acceleration = 100};
  all[2].range = {.speed = 40, .acceleration = 0.5};
  all[3].range = {.speed = 10, .acceleration = 1000};
  all[4].range = {.lower = -1, .upper = 2, .speed = 6, .acceleration = 60};
  all[5].range = {.upper = 1.5, .speed = 3, .acceleration = 20};
  all[6].leader = 4;
  all[6].multiplier = -0.5;
  all[6].offset = 0.1;
  all[0].four = together;
  return all;
}

std::vector<Vehicle> team(std::mt19937& random, std::size_t count, double spin) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double most) { return Vec3(most * unit(random), most * unit(random), most * unit(random)); };
  std::vector<Vehicle> all(count);
  for (Vehicle& v : all) {
    v.pose = {vector(50), rotation_of(vector(3))};
    v.twist = {vector(5), vector(spin)};
    v.wrench = {vector(100), vector(10)};
    v.second = {vector(10), vector(1)};
    for (int k = 0; k < joint_count; ++k) {
      v.position[k] = k < 4 ? 100 * unit(random) : unit(random);
      v.velocity[k] = k < 4 ? 20 * unit(random) : 3 * unit(random);
      v.target[k] = k < 4 ? 50 * unit(random) : 4 * unit(random);
    }
  }
  return all;
}

/// Moves all vehicles by a step, `at_once` at a time. Returns a bit for each that is no longer finite.
unsigned move(std::vector<Vehicle>& all, lane::Isa isa, int at_once, const std::vector<Joint>& joints,
              Mode mode = Mode::velocity, int wrenches = 1) {
  std::vector<RobotState> states;
  std::vector<const double*> other_contributions;
  for (Vehicle& v : all) {
    states.push_back(v.state());
    if (wrenches == 2) other_contributions.push_back(lane::numbers(&v.second));
  }
  unsigned broken = 0;
  const int count = int(all.size());
  for (int k = 0; k < count; k += at_once) {
    const BatchParameters batch{
        .mode = mode,
        .joints = joints.data(),
        .joint_count = int(joints.size()),
        .mass = &vehicle_mass,
        .wrenches = wrenches,
        .other_contributions = wrenches > 1 ? other_contributions.data() + k * (wrenches - 1) : nullptr,
        .gravity = {0, 0, -9.81},
        .dt = 0.001};
    broken |= kernels_for(isa).move_rigid(batch, &states[std::size_t(k)], std::min(at_once, count - k)) << k;
  }
  return broken;
}

/// Slow spins use the series, fast spins use sine and cosine, and a lane may have both.
TEST(MoveKernel, RobotsMovedTogetherGetTheBitsOfEachAlone) {
  std::mt19937 random(5);
  for (const double spin : {1.0, 300.0})
    for (const Mode mode : {Mode::velocity, Mode::position, Mode::acceleration})
      for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512})
        for (const int at_once : {8, 7, 5, 3, 1}) {
          if (isa > lane::best_isa()) continue;  // this processor cannot run it
          const int wrenches = at_once % 3;
          std::vector<Vehicle> together = team(random, 8, spin), alone = together;
          for (int step = 0; step < 100; ++step) {
            EXPECT_EQ(move(together, isa, at_once, joints(true), mode, wrenches), 0u);
            EXPECT_EQ(move(alone, lane::Isa::base, 1, joints(false), mode, wrenches), 0u);
            for (std::size_t k = 0; k < 8; ++k)
              ASSERT_TRUE(alone[k].equals(together[k])) << "robot " << k << ", step " << step;
          }
        }
}

TEST(MoveKernel, AWheelTakesOnItsTargetWithinItsLimits) {
  std::mt19937 random(6);
  std::vector<Vehicle> one = team(random, 1, 1);
  Vehicle& v = one[0];
  for (int k = 0; k < 4; ++k) v.velocity[k] = v.position[k] = 0;
  v.target[0] = v.target[1] = v.target[2] = 5;
  v.target[3] = -50;
  for (int step = 0; step < 1000; ++step) move(one, lane::best_isa(), 1, joints(true));
  EXPECT_NEAR(v.velocity[0], 5, 1e-12);
  EXPECT_NEAR(v.velocity[1], 1, 1e-12) << "the greatest speed";
  EXPECT_NEAR(v.velocity[2], 0.5, 1e-12) << "half a rad/s^2 for one second";
  EXPECT_NEAR(v.velocity[3], -10, 1e-12);
  EXPECT_NEAR(v.position[0], 5 * (1 - 0.05) + 0.5 * 0.05 * 5, 1e-9) << "uniform acceleration for 5/100 s";
  EXPECT_NEAR(v.position[2], 0.25, 1e-12);
}

TEST(MoveKernel, AddsUpAllContributionsToTheWrench) {
  std::mt19937 random(8);
  std::vector<Vehicle> two = team(random, 8, 1), sum = two;
  for (Vehicle& v : sum) v.wrench += v.second;
  move(two, lane::best_isa(), 8, joints(true), Mode::velocity, 2);
  move(sum, lane::best_isa(), 8, joints(true), Mode::velocity, 1);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_TRUE(two[k].equals(sum[k]));
}

TEST(MoveKernel, TellsWhoIsNoLongerFinite) {
  std::mt19937 random(7);
  std::vector<Vehicle> all = team(random, 8, 1);
  all[2].wrench.force.x() = std::nan("");
  all[5].wrench.torque.z() = HUGE_VAL;
  for (const int at_once : {8, 6, 1})
    EXPECT_EQ(move(all, lane::best_isa(), at_once, joints(true)), (1u << 2) | (1u << 5));
}

}  // namespace
}  // namespace muro::simplified
