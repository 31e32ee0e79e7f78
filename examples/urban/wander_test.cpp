// SPDX-License-Identifier: MIT
// wander.c in a city of closed-form rays, without the simulator: see flat_city.hpp.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <set>
#include <string>

#include "flat_city.hpp"

namespace {

using namespace flat;

const muro_controller_table& control() { return *muro_controller(); }

constexpr int steps_per_second = 10;
constexpr double pi = M_PI;

struct Trip {
  double min_clearance = 1e9;  ///< m, to all standing objects
  std::set<std::pair<int, int>> crossings;
};

/// Drives for `seconds`; `disturb` changes each reading, `watch` is called after every step.
template <class Disturb>
Trip drive(Vehicle& v, const City& city, double seconds, Disturb disturb,
           const std::function<void(double)>& watch = {}) {
  Trip trip;
  for (int k = 0; k < seconds * steps_per_second; ++k) {
    v.control(0.1 * k, city.near(v.pose), disturb);
    for (int i = 0; i < 10; ++i) v.move(0.01);
    trip.min_clearance = std::min(trip.min_clearance, city.clearance(v));
    const double x = v.pose.x / 10, y = v.pose.y / 10;  // streets lie at half tens for an odd number of blocks
    if (std::abs(x - std::floor(x) - 0.5) < 0.2 && std::abs(y - std::floor(y) - 0.5) < 0.2)
      trip.crossings.insert({int(std::floor(x)), int(std::floor(y))});
    if (watch) watch(0.1 * k);
  }
  return trip;
}

void undisturbed(double&) {}

/// A street of 4 m along x without side streets, from `from` to `to`; closed at `to`.
City street(double from, double to) {
  City c;
  const double middle = (from + to) / 2, half = (to - from) / 2;
  c.boxes = {{{middle, 3, 0}, half, 1}, {{middle, -3, 0}, half, 1}, {{to + 1, 0, 0}, 1, 4}};
  return c;
}

TEST(Wander, DrivesFarThroughACityAndTouchesNothing) {
  const City city(5);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Vehicle v(control(), {-24.2, double(seed) - 4, pi / 2}, seed);
    const Trip trip = drive(v, city, 300, undisturbed);
    EXPECT_GT(trip.min_clearance, 0.05) << "seed " << seed;
    EXPECT_GT(v.distance_driven(), 150) << "seed " << seed;
    EXPECT_GE(trip.crossings.size(), 6u) << "seed " << seed;
  }
}

TEST(Wander, ToleratesNoiseAndLostRaysOfARealScanner) {
  const City city(5);
  std::mt19937 engine(7);
  std::normal_distribution<double> noise(0, 0.02);
  std::uniform_real_distribution<double> chance;
  const auto disturb = [&](double& range) {
    if (range < Vehicle::max_range) range += noise(engine);
    if (chance(engine) < 0.02) range = 0;
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Vehicle v(control(), {-24.2, 0, pi / 2}, seed);
    const Trip trip = drive(v, city, 120, disturb);
    EXPECT_GT(trip.min_clearance, 0.05) << "seed " << seed;
    EXPECT_GT(v.distance_driven(), 60) << "seed " << seed;
  }
}

TEST(Wander, KeepsToTheRightFromAnywhereInTheStreet) {
  const City city = street(-10, 60);
  for (const double y : {-1.4, -0.8, 0.0, 1.4})
    for (const double heading : {-0.6, 0.0, 0.6}) {
      Vehicle v(control(), {0, y, heading}, 1);
      drive(v, city, 30, undisturbed);
      EXPECT_GT(v.pose.x, 15) << y << " " << heading;
      EXPECT_NEAR(v.pose.y, -0.8, 0.1) << y << " " << heading;  // 1.2 m from the wall at y = -2
      EXPECT_NEAR(v.pose.heading, 0, 0.05) << y << " " << heading;
    }
}

TEST(Wander, TurnsAroundInADeadEnd) {
  const City city = street(-20, 8);
  for (const double y : {-0.8, 0.0, 0.8}) {
    Vehicle v(control(), {0, y, 0}, 1);
    double farthest = 0, min_distance = 1e9;
    drive(v, city, 40, undisturbed, [&](double) {
      farthest = std::max(farthest, v.pose.x);
      min_distance = v.pose.x > -15 ? std::min(min_distance, city.clearance(v)) : min_distance;
    });
    EXPECT_GT(farthest, 4) << y;
    EXPECT_LT(v.pose.x, -5) << y;
    EXPECT_GT(min_distance, 0.05) << y;
  }
}

TEST(Wander, ChoosesTheSideByChanceWhereItHasToTurnOnTheSpot) {
  City alley;  // 1.6 m wide
  alley.boxes = {{{-6, 1.8, 0}, 14, 1}, {{-6, -1.8, 0}, 14, 1}, {{9, 0, 0}, 1, 4}};
  int left = 0, right = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Vehicle v(control(), {0, 0, 0}, seed);
    double min_distance = 1e9;
    drive(v, alley, 30, undisturbed, [&](double) { min_distance = std::min(min_distance, alley.clearance(v)); });
    EXPECT_LT(v.pose.x, 2) << "seed " << seed;
    EXPECT_GT(min_distance, 0.05) << "seed " << seed;
    (v.turned() > 0 ? left : right) += 1;
  }
  EXPECT_GE(left, 5);
  EXPECT_GE(right, 5);
}

TEST(Wander, TurnsOnTheSpotWhereThereIsNoRoomToDrive) {
  City cage;
  cage.boxes = {{{1.8, 0, 0}, 1, 3}, {{-1.8, 0, 0}, 1, 3}, {{0, 1.8, 0}, 3, 1}, {{0, -1.8, 0}, 3, 1}};
  Vehicle v(control(), {0, 0, 0.3}, 5);
  const Trip trip = drive(v, cage, 30, undisturbed);
  EXPECT_EQ(v.distance_driven(), 0);
  EXPECT_GT(std::abs(v.turned()), 4 * pi);
  EXPECT_GT(trip.min_clearance, 0.3);
}

TEST(Wander, PassesAParkedVehicleAndAnOncomingOne) {
  const City city = street(-10, 60);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Vehicle v(control(), {0, -0.8, 0}, seed), opposite(control(), {20, 0.8 - 0.2 * double(seed), pi}, seed + 100);
    Box parked{{8, -0.8, 0.1 * double(seed)}, 0.2, 0.17};
    double min_distance = 1e9;
    for (int k = 0; k < 30 * steps_per_second; ++k) {
      const Box a = v.body(), b = opposite.body();
      for (auto& [self, other] : {std::pair{&v, &b}, std::pair{&opposite, &a}}) {
        auto seen = city.near(self->pose);
        seen.push_back(other);
        seen.push_back(&parked);
        self->control(0.1 * k, seen);
      }
      for (int i = 0; i < 10; ++i) v.move(0.01), opposite.move(0.01);
      min_distance = std::min({min_distance, distance(v.body(), opposite.body()), distance(v.body(), parked),
                               distance(opposite.body(), parked), city.clearance(v)});
    }
    EXPECT_GT(min_distance, 0.05) << "seed " << seed;
    EXPECT_GT(v.pose.x, 12) << "seed " << seed;
    EXPECT_LT(opposite.pose.x, 8) << "seed " << seed;
  }
}

TEST(Wander, LetsFortyVehiclesShareTheStreets) {
  const City city(5);
  std::vector<std::unique_ptr<Vehicle>> vehicles;
  for (int i = 0; i < 40; ++i) {  // on four streets along x, in both lanes
    const double row = -15 + 10 * (i % 4), column = -20 + 4.6 * std::floor(0.25 * i);
    const bool east = i / 4 % 2 == 0;
    vehicles.push_back(
        std::make_unique<Vehicle>(control(), Pose2d{column, row + (east ? -0.8 : 0.8), east ? 0 : pi}, 1000 + i));
  }
  double clearance = 1e9, gap = 1e9;
  for (int k = 0; k < 60 * steps_per_second; ++k) {
    std::vector<Box> bodies;
    for (const auto& v : vehicles) bodies.push_back(v->body());
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      const Pose2d& p = vehicles[i]->pose;
      auto seen = city.near(p);
      for (std::size_t j = 0; j < bodies.size(); ++j)
        if (j != i && bodies[j].distance({p.x, p.y}) < 6) seen.push_back(&bodies[j]);
      vehicles[i]->control(0.1 * k, seen);
    }
    for (const auto& v : vehicles) {
      for (int i = 0; i < 10; ++i) v->move(0.01);
      clearance = std::min(clearance, city.clearance(*v));
    }
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) gap = std::min(gap, distance(vehicles[i]->body(), vehicles[j]->body()));
  }
  EXPECT_GT(clearance, 0.02);
  EXPECT_GT(gap, 0);
  for (const auto& v : vehicles) EXPECT_GT(v->distance_driven(), 20);
}

TEST(Wander, KeepsAllItsStateInItsBlock) {
  const City city(3);
  Vehicle v(control(), {-14.2, 0, pi / 2}, 3);
  drive(v, city, 20, undisturbed);
  Vehicle copy = v, other(control(), {5, -4.2, 0}, 4);  // the copy has the bytes of the block
  for (int k = 200; k < 800; ++k) {
    v.control(0.1 * k, city.near(v.pose));
    other.control(0.1 * k, city.near(other.pose));
    v.move(0.1);
    other.move(0.1);
  }
  for (int k = 200; k < 800; ++k) {
    copy.control(0.1 * k, city.near(copy.pose));
    copy.move(0.1);
  }
  EXPECT_EQ(v.pose.x, copy.pose.x);
  EXPECT_EQ(v.pose.y, copy.pose.y);
  EXPECT_EQ(v.pose.heading, copy.pose.heading);
}

TEST(Wander, TakesItsSpeedFromAnArgument) {
  const City city = street(-10, 60);
  Vehicle slow(control(), {0, -0.8, 0}, 1, {"speed=0.4"}),
      fast(control(), {0, -0.8, 0}, 1, {"speed=0.9", "laser_x=0.1"});
  drive(slow, city, 20, undisturbed);
  drive(fast, city, 20, undisturbed);
  EXPECT_NEAR(slow.distance_driven(), 8, 0.5);
  EXPECT_NEAR(fast.distance_driven(), 18, 1);
}

TEST(Wander, NamesAnArgumentThatItDoesNotKnow) {
  for (const char* wrong : {"sped=0.4", "speed=", "speed=fast", "speed=1e9", "speed=nan", "speed=0.4x", "speed"}) {
    try {
      Vehicle v(control(), {}, 1, {wrong});
      ADD_FAILURE() << wrong;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(std::string(e.what()),
                "argument `" + std::string(wrong) + "` is none of: speed=0.1..2 (m/s), laser_x=-1..1 (m)");
    }
  }
}

}  // namespace
