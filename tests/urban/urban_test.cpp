// SPDX-License-Identifier: MIT
// The main example: the urban team, observed while it runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string urban = MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml";

BuiltScenario open(const std::vector<std::string>& overrides = {}) {
  return build(read_scenario(urban, overrides), test::plugins());
}

/// Extremes of the recorded poses of a robot.
struct Trajectory {
  double distance = 0;
  double farthest = 0;                  ///< m, from the start
  double lowest = 1e9, highest = -1e9;  ///< of the base, m
  double max_tilt = 0;                  ///< rad between the body's z axis and the vertical
  double deepest_in_wall = -1e9;  ///< m by which a corner of the chassis was inside a building or beyond the walls
};

/// Returns how deep (m) a point is inside the city's buildings (10 x 10 blocks of 10 m, 6 m wide) or outside its walls.
double inside_building(const Vec3& p) {
  const auto distance_to_middle = [](double x) { return std::abs(x - (std::floor(x / 10) * 10 + 5)); };
  const double building = std::abs(p.x()) < 50 && std::abs(p.y()) < 50
                              ? std::min(3 - distance_to_middle(p.x()), 3 - distance_to_middle(p.y()))
                              : -1e9;
  return std::max(building, std::max(std::abs(p.x()), std::abs(p.y())) - 52);
}

std::vector<Trajectory> run_and_observe(BuiltScenario& built, double seconds) {
  Simulation& s = *built.simulation;
  const auto robots = s.world().robots();
  std::vector<Trajectory> trajectories(robots.size());
  std::vector<Vec3> start, last;
  for (const RobotView* r : robots) start.push_back(s.world().value(r->base(), keys::pose).position);
  last = start;
  for (double t = 0; t < seconds; t += 0.05) {
    s.run_for(0.05);
    for (const RobotView* r : robots) {
      const Pose& pose = s.world().value(r->base(), keys::pose);
      Trajectory& trajectory = trajectories[index_of(r->id)];
      trajectory.distance += (pose.position - last[index_of(r->id)]).norm();
      trajectory.farthest = std::max(trajectory.farthest, (pose.position - start[index_of(r->id)]).norm());
      trajectory.lowest = std::min(trajectory.lowest, pose.position.z());
      trajectory.highest = std::max(trajectory.highest, pose.position.z());
      trajectory.max_tilt =
          std::max(trajectory.max_tilt, std::acos(std::clamp((pose.orientation * Vec3::UnitZ()).z(), -1.0, 1.0)));
      for (const double x : {-0.175, 0.175})
        for (const double y : {-0.125, 0.125})
          trajectory.deepest_in_wall = std::max(trajectory.deepest_in_wall, inside_building(pose * Vec3(x, y, 0)));
      last[index_of(r->id)] = pose.position;
    }
  }
  return trajectories;
}

TEST(Urban, TwentyVehiclesTravelAMinuteThroughNoWallAndNoGround) {
  BuiltScenario built = open();
  ASSERT_GE(built.simulation->world().robots().size(), 20u);
  const std::vector<Trajectory> trajectories = run_and_observe(built, 60);
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    SCOPED_TRACE("rover " + std::to_string(i));
    EXPECT_GT(trajectories[i].distance, 10) << "m";
    EXPECT_GT(trajectories[i].farthest, 2) << "m from its start: it does not turn on the spot";
    EXPECT_GT(trajectories[i].lowest, 0.09 - 0.01) << "the ride height is 0.09 m";
    EXPECT_LT(trajectories[i].highest, 0.09 + 0.05);
    EXPECT_LT(trajectories[i].max_tilt, 0.35);
    EXPECT_LT(trajectories[i].deepest_in_wall, 0.01);
  }
}

TEST(Urban, OneTeamDrivesAtThreeLevelsWithOneModelAndOneControlLibrary) {
  BuiltScenario built =
      open({"robots.rovers[0-4].motion.use=motion.differential_drive", "robots.rovers[5-9].motion.use=motion.point"});
  std::map<std::string, std::size_t> robots_of;
  for (const auto& i : built.simulation->instances()) robots_of[i->setup().use] += i->setup().items.size();
  EXPECT_EQ(robots_of["motion.differential_drive"], 5u);
  EXPECT_EQ(robots_of["motion.point"], 5u);
  EXPECT_EQ(robots_of["motion.simplified"], 10u);
  EXPECT_EQ(robots_of["controller.library"], 20u);
  const std::vector<Trajectory> trajectories = run_and_observe(built, 20);
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    SCOPED_TRACE("rover " + std::to_string(i));
    EXPECT_GT(trajectories[i].distance, 3);
    EXPECT_LT(trajectories[i].deepest_in_wall, 0.01);
    if (i < 10) {
      EXPECT_NEAR(trajectories[i].highest, trajectories[i].lowest, 1e-9) << "kinematic robots keep their height";
    }
  }
}

TEST(Urban, EveryOverrideOfTheReadmeWorks) {
  EXPECT_EQ(open({"robots.rovers.count=100"}).simulation->world().robots().size(), 100u);
  open({"robots.rovers.motion.use=motion.point"}).simulation->run_for(0.2);
}

TEST(Urban, WithoutLasersTheTeamStandsStill) {
  BuiltScenario blind = open({"robots.rovers.laser=off"});
  for (const auto& i : blind.simulation->instances()) EXPECT_NE(i->setup().use, "laser.raycast");
  for (const Trajectory& trajectory : run_and_observe(blind, 2)) EXPECT_LT(trajectory.farthest, 0.001);
}

}  // namespace
}  // namespace muro::host
