// SPDX-License-Identifier: MIT
// Robots that control code puts somewhere.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

struct Pitch : test::Scene {
  const RobotView& ball =
      add("ball", test::single_body(Shape::sphere(0.1), {.mass = 0.4, .ixx = 1.6e-3, .iyy = 1.6e-3, .izz = 1.6e-3}),
          {{3, 0, 0.1}, Quat::Identity()});
  std::string log;

  Pitch() {
    add_ground();
    use("motion.simplified", 1000, all_robots());
    use_contacts();
    use("controller.placement", 100, all_robots());
    set_log([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
    build();
  }
  template <class T>
  T& of(const char* key) {
    return *static_cast<T*>(world().store().find(ball.base(), key)->place);
  }
  void ask(const Pose& pose, const Twist& twist = {}) {
    of<Pose>("place.pose") = pose;
    of<Twist>("place.twist") = twist;
    ++of<std::int64_t>("place.count");
  }
};

TEST(PlacementByControlCode, PutsARobotWhereItIsAskedForOnce) {
  Pitch p;
  p.run_for(0.1);
  p.ask({{-2, 1, 0.1}, Quat(2, 0, 0, 0)});
  p.run_for(0.05);
  EXPECT_LT((p.pose(p.ball).position - Vec3(-2, 1, 0.1)).norm(), 2e-3);
  EXPECT_NEAR(p.pose(p.ball).orientation.norm(), 1, 1e-9);
  EXPECT_EQ(p.of<std::int64_t>("place.answer"), 1);
  p.pose(p.ball).position.x() = 5;
  p.run_for(0.05);
  EXPECT_NEAR(p.pose(p.ball).position.x(), 5, 1e-3) << "one request puts it there once";
}

TEST(PlacementByControlCode, ThrowsIt) {
  Pitch p;
  p.ask({{0, 0, 1}, Quat::Identity()}, {{1, 0, 2}, {0, 0, 0}});
  p.run_for(0.3);
  EXPECT_NEAR(p.pose(p.ball).position.z(), 1 + 2 * 0.3 - 9.81 * 0.09 / 2, 0.01);
}

TEST(PlacementByControlCode, AnswersWhatItRefuses) {
  Pitch p;
  p.ask({{std::nan(""), 0, 0}, Quat::Identity()});
  p.run_for(0.05);
  EXPECT_EQ(p.of<std::int64_t>("place.answer"), -2);
  EXPECT_SAYS(p.log, "robot `ball` was not put elsewhere: the pose for `ball/body` has a coordinate");
  EXPECT_NEAR(p.pose(p.ball).position.x(), 3, 1e-3);
}

TEST(PlacementByControlCode, IsAPartOfSnapshots) {
  Pitch p;
  p.run_for(0.1);
  const Snapshot before = p.snapshot();
  p.ask({{-2, 1, 0.1}, Quat::Identity()});
  p.run_for(0.1);
  const std::uint64_t hash = p.state_hash();
  p.restore(before);
  p.run_for(0.02);
  EXPECT_NEAR(p.pose(p.ball).position.x(), 3, 1e-3);
  p.restore(before);
  p.ask({{-2, 1, 0.1}, Quat::Identity()});
  p.run_for(0.1);
  EXPECT_EQ(p.state_hash(), hash);
}

}  // namespace
}  // namespace muro
