// SPDX-License-Identifier: MIT
#include "host/scenario/placement.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::host {
namespace {

Body body(const char* name, double height, double radius) {
  return {name, [height](const Pose&) { return height; }, radius};
}

struct PlacementTest : ::testing::Test {
  std::map<std::string, std::vector<Rectangle>> places{{"yard", {{0, 0, 10, 4, {0.5}}, {20, 0, 2, 2, {}}}}};
  Obstacle obstacle{{{0, 0, 1}, from_rpy(0, 0, 0.3)}, 2, 1};
  Occupancy occupied = with_obstacle();
  Occupancy with_obstacle() const {
    Occupancy taken;
    taken.add(obstacle);
    return taken;
  }
  Placement random = [] {
    Placement p;
    p.kind = Placement::Kind::random;
    p.area = "yard";
    p.seed = 7;
    p.clearance = 0.1;
    p.poses.emplace_back();
    return p;
  }();
};

TEST_F(PlacementTest, RandomPlacesKeepTheirDistanceToEverything) {
  const auto poses = place(random, 30, body("rovers", 0.25, 0.3), places, occupied);
  ASSERT_EQ(poses.size(), 30u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3& p = poses[i].position;
    EXPECT_EQ(p.z(), 0.25);
    const bool in_first = std::abs(p.x()) <= 5 && std::abs(p.y()) <= 2,
               in_second = std::abs(p.x() - 20) <= 1 && std::abs(p.y()) <= 1;
    EXPECT_TRUE(in_first || in_second);
    if (in_first) {
      EXPECT_NEAR(yaw_of(poses[i].orientation), 0.5, 1e-12);
    }
    for (std::size_t k = 0; k < i; ++k) EXPECT_GE((p - poses[k].position).norm(), 0.7);
    const Vec3 local = obstacle.pose.inverse() * Vec3(p.x(), p.y(), 1);
    EXPECT_GE(std::hypot(std::max(0.0, std::abs(local.x()) - 2), std::max(0.0, std::abs(local.y()) - 1)), 0.4);
  }
}

TEST_F(PlacementTest, EqualSeedsGiveEqualPlacesAndOthersDoNot) {
  Occupancy again = with_obstacle(), other = with_obstacle();
  const auto a = place(random, 5, body("rovers", 0, 0.3), places, occupied);
  const auto b = place(random, 5, body("rovers", 0, 0.3), places, again);
  random.seed = 8;
  const auto c = place(random, 5, body("rovers", 0, 0.3), places, other);
  EXPECT_EQ(a[4].position, b[4].position);
  EXPECT_NE(a[4].position, c[4].position);
}

TEST_F(PlacementTest, SmallSeedsShareNoPlaces) {
  std::vector<Vec3> positions;
  for (const std::uint64_t seed : {0, 1, 2, 3}) {
    Occupancy empty;
    random.seed = seed;
    for (const Pose& pose : place(random, 8, body("rovers", 0, 0.1), places, empty)) positions.push_back(pose.position);
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(positions[i], positions[k]) << i << " and " << k;
}

TEST_F(PlacementTest, AFullPlaceSaysHowManyFit) {
  random.location = {"a.yaml", 3, 5};
  try {
    place(random, 5000, body("rovers", 0, 0.3), places, occupied);
    FAIL();
  } catch (const SetupError& e) {
    const std::string text = e.what();
    EXPECT_EQ(text.rfind("a.yaml:3:5: only ", 0), 0u);
    EXPECT_NE(text.find(" of 5000 copies of `rovers` fit into `yard` without overlap"), std::string::npos);
  }
}

TEST_F(PlacementTest, AGridIsCentredAndTurnsWithItsCentre) {
  Placement grid;
  grid.kind = Placement::Kind::grid;
  grid.columns = 3;
  grid.rows = 2;
  grid.spacing_x = 2;
  grid.spacing_y = 4;
  grid.poses.push_back({.x = 10, .y = 0, .z = {}, .yaw = M_PI / 2});
  const auto poses = place(grid, 6, body("posts", 0.5, 1), places, occupied);
  EXPECT_LT((poses[0].position - Vec3(12, -2, 0.5)).norm(), 1e-12);
  EXPECT_LT((poses[5].position - Vec3(8, 2, 0.5)).norm(), 1e-12);
}

}  // namespace
}  // namespace muro::host
