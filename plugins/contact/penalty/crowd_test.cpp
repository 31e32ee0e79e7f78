// SPDX-License-Identifier: MIT
// Vehicles that push each other, and vehicles on hills: whole steps of collision.native, contact.penalty and
// motion.simplified.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "penalty_testing.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hills.hpp"

namespace muro {
namespace {

using namespace test;

/// Rovers wheel to wheel, with any headings, that drive into each other.
struct Crowd : ContactScene {
  std::vector<const RobotView*> robots;

  Crowd() {
    add_ground(0.8);
    add_rovers(0.38, 16);
    start();
  }
  explicit Crowd(const Hills& hills) {
    hills.add_to(*this);
    add_rovers(1.5, 9);
    start();
  }
  /// Sets the wheel speeds of all rovers, which are not part of a snapshot.
  void drive() {
    for (std::size_t k = 0; k < robots.size(); ++k)
      wheels("r" + std::to_string(k), 3 + double(k % 5), 4 - double(k % 3));
  }
  int touching() {
    int count = 0;
    for (const RobotView* r : robots)
      for (const Contact& c : contacts(*r)) count += world().robot_of(c.other) != no_robot;
    return count;
  }
  void expect_the_same_poses(const std::vector<Pose>& expected) {
    for (std::size_t k = 0; k < robots.size(); ++k) {
      EXPECT_EQ(pose(*robots[k]).position, expected[k].position) << k;
      EXPECT_EQ(pose(*robots[k]).orientation.coeffs(), expected[k].orientation.coeffs()) << k;
    }
  }
  std::vector<Pose> poses() {
    std::vector<Pose> all;
    for (const RobotView* r : robots) all.push_back(pose(*r));
    return all;
  }

 private:
  void add_rovers(double apart, int count) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> heading(-M_PI, M_PI);
    for (int k = 0; k < count; ++k)
      robots.push_back(&add("r" + std::to_string(k), rover(0.8),
                            {{apart * (k % 4), apart * (k / 4), 0.09}, from_rpy(0, 0, heading(random))}));
  }
};

TEST(Crowd, GoesOnFromSnapshotsToTheSameBits) {
  Crowd crowd;
  crowd.drive();
  crowd.run_for(0.3);
  ASSERT_GT(crowd.touching(), 10);
  const Snapshot middle = crowd.snapshot();
  crowd.run_for(0.06);
  const std::vector<Pose> expected = crowd.poses();
  crowd.restore(middle);
  for (int k = 0; k < 20; ++k) {  // what algorithms know of earlier steps is forgotten each time
    crowd.drive();
    crowd.run_for(0.003);
    const Snapshot snapshot = crowd.snapshot();
    crowd.restore(snapshot);
  }
  crowd.expect_the_same_poses(expected);
}

/// Returns the allocations in a second that is run again. The first step after a restore starts the algorithms.
std::uint64_t allocations_when_warm(Crowd& crowd) {
  const Snapshot start = crowd.snapshot();
  crowd.drive();
  crowd.run_for(1.01);
  crowd.restore(start);
  crowd.drive();
  crowd.run_for(0.01);
  const std::uint64_t before = allocations();
  crowd.run_for(1);
  return allocations() - before;
}

TEST(Crowd, AllocatesNothingInAStepOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(allocations(), 0u) << "sanitizers count allocations themselves";
#else
  Crowd crowd;
  EXPECT_EQ(allocations_when_warm(crowd), 0u);
  EXPECT_GT(crowd.touching(), 5);
#endif
}

TEST(Crowd, OfVehiclesOnHillsAllocatesNothingOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(allocations(), 0u) << "sanitizers count allocations themselves";
#else
  const Hills hills(12, 60, [](double x, double y) { return 0.2 * std::sin(1.3 * x) * std::sin(y) - 0.05; });
  Crowd crowd(hills);
  EXPECT_EQ(allocations_when_warm(crowd), 0u);
#endif
}

}  // namespace
}  // namespace muro
