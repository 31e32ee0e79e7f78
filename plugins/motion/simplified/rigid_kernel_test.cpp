// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "muro/geometry.hpp"
#include "rigid.hpp"

namespace muro::simplified {
namespace {

/// A vehicle with four wheels and numbers of its own.
struct Vehicle {
  Pose pose;
  Twist twist;
  Wrench wrench;
  double position[4], velocity[4], target[4];
  Wheel wheels[4];

  RigidRobot view() {
    for (int k = 0; k < 4; ++k) wheels[k] = {&position[k], &velocity[k], &target[k]};
    return {pose.position.data(), twist.linear.data(), wrench.force.data(), wheels};
  }
  bool equals(const Vehicle& b) const {
    return std::memcmp(&pose, &b.pose, sizeof pose) == 0 && std::memcmp(&twist, &b.twist, sizeof twist) == 0 &&
           std::memcmp(position, b.position, sizeof position) == 0 &&
           std::memcmp(velocity, b.velocity, sizeof velocity) == 0;
  }
};

constexpr RigidModel model{
    0.2, {0.01, -0.02, 0.03}, {0.05, 0.001, 0, 0.001, 0.07, 0, 0, 0, 0.1}, {20, -0.3, 0, -0.3, 14, 0, 0, 0, 10}};
constexpr WheelLimits limits[4] = {{40, 100}, {1, 100}, {40, 0.5}, {10, 1000}};

RigidWork work(double dt) { return {&model, limits, 4, {0, 0, -9.81}, dt}; }

std::vector<Vehicle> eight(std::mt19937& random, double spin) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Vehicle> all(8);
  for (Vehicle& v : all) {
    const auto vector = [&](double most) {
      return Vec3(most * unit(random), most * unit(random), most * unit(random));
    };
    v.pose = {vector(50), rotation_of(vector(3))};
    v.twist = {vector(5), vector(spin)};
    v.wrench = {vector(100), vector(10)};
    for (int k = 0; k < 4; ++k) {
      v.position[k] = 100 * unit(random);
      v.velocity[k] = 20 * unit(random);
      v.target[k] = 50 * unit(random);
    }
  }
  return all;
}

/// Slow spins take the series, fast ones sine and cosine, and a lane may have both.
TEST(RigidKernel, EightRobotsAtOnceGetTheBitsOfEachAloneWithAnyInstructionSet) {
  std::mt19937 random(5);
  for (const double spin : {1.0, 300.0})
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512}) {
      if (isa > lane::best_isa()) continue;  // this processor cannot run it
      std::vector<Vehicle> together = eight(random, spin), alone = together;
      for (int step = 0; step < 100; ++step) {
        std::vector<RigidRobot> robots;
        for (Vehicle& v : together) robots.push_back(v.view());
        EXPECT_EQ(rigid_kernels_for(isa).move_eight(work(0.001), robots.data()), 0u);
        for (std::size_t k = 0; k < 8; ++k) {
          const RigidRobot robot = alone[k].view();
          EXPECT_EQ(rigid_kernels_for(lane::Isa::base).move_one(work(0.001), &robot), 0u);
          ASSERT_TRUE(alone[k].equals(together[k])) << "robot " << k << ", step " << step;
        }
      }
    }
}

TEST(RigidKernel, AWheelTakesOnItsTargetWithinItsLimits) {
  std::mt19937 random(6);
  Vehicle v = eight(random, 1)[0];
  for (int k = 0; k < 4; ++k) v.velocity[k] = v.position[k] = 0;
  v.target[0] = v.target[1] = v.target[2] = 5;
  v.target[3] = -50;
  const RigidRobot robot = v.view();
  for (int step = 0; step < 1000; ++step) rigid_kernels_for(lane::best_isa()).move_one(work(0.001), &robot);
  EXPECT_NEAR(v.velocity[0], 5, 1e-12);
  EXPECT_NEAR(v.velocity[1], 1, 1e-12) << "the greatest speed";
  EXPECT_NEAR(v.velocity[2], 0.5, 1e-12) << "half a rad/s^2 for one second";
  EXPECT_NEAR(v.velocity[3], -10, 1e-12);
  EXPECT_NEAR(v.position[0], 5 * (1 - 0.05) + 0.5 * 0.05 * 5, 1e-9) << "uniform acceleration for 5/100 s";
  EXPECT_NEAR(v.position[2], 0.25, 1e-12);
}

TEST(RigidKernel, TellsWhoIsNoLongerFinite) {
  std::mt19937 random(7);
  std::vector<Vehicle> all = eight(random, 1);
  all[2].wrench.force.x() = std::nan("");
  all[5].wrench.torque.z() = HUGE_VAL;
  std::vector<RigidRobot> robots;
  for (Vehicle& v : all) robots.push_back(v.view());
  EXPECT_EQ(rigid_kernels_for(lane::best_isa()).move_eight(work(0.001), robots.data()), (1u << 2) | (1u << 5));
}

}  // namespace
}  // namespace muro::simplified
