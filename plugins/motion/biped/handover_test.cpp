// SPDX-License-Identifier: MIT
// Robots at a new pose: at the start, from other motions, put somewhere, from snapshots.
#include <gtest/gtest.h>

#include "walker_testing.hpp"

namespace muro::biped::testing {
namespace {

double lowest_corner(Walk& w, const std::string& foot) {
  double lowest = 1e9;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {0.0, 0.02})
        lowest = std::min(lowest, (w.link(foot) * Vec3(x * foot_length, y * 0.05, z)).z());
  return lowest;
}

TEST(ABipedThatIsPutAnywhere, StandsOnItsLowerFootWithTheSmallestTurn) {
  const Quat yaw = from_rpy(0, 0, 0.8);
  const struct {
    Pose at;
    Quat stands;
  } cases[] = {
      {{{1, 2, 5}, yaw}, yaw},                              // in the air
      {{{1, 2, -5}, yaw}, yaw},                             // under the ground
      {{{1, 2, 1}, yaw * from_rpy(0, M_PI / 2, 0)}, yaw},   // on its face
      {{{1, 2, 1}, yaw * from_rpy(0, -M_PI / 2, 0)}, yaw},  // on its back
      {{{1, 2, 1}, yaw * from_rpy(0.3, 0, 0)}, yaw},        // leaning to its right
  };
  for (const auto& c : cases) {
    for (const bool at_start : {true, false}) {
      Walk w(100, {}, {}, {}, {flat_sole()}, at_start ? c.at : Pose{});
      if (!at_start) w.place({w.robot.base(), c.at});
      w.run_for(0.02);
      EXPECT_LT(w.base().orientation.angularDistance(c.stands), 1e-9);
      EXPECT_NEAR(w.base().position.z(), leg_length, 1e-12);
      EXPECT_NEAR(lowest_corner(w, "left_foot"), 0, 1e-12);
      EXPECT_LT((w.base().position - c.at.position).head<2>().norm(), leg_length + 0.1) << "near where it was";
    }
  }
}

TEST(ABipedThatIsPutAnywhere, LeaningStandsOnTheFootThatWasLower) {
  Walk right(100, {}, {}, {}, {flat_sole()}, {{0, 0, 1}, from_rpy(0.3, 0, 0)});
  EXPECT_EQ(right.stance(own::stance_foot), 1u);
  Walk left(100, {}, {}, {}, {flat_sole()}, {{0, 0, 1}, from_rpy(-0.3, 0, 0)});
  EXPECT_EQ(left.stance(own::stance_foot), 0u);
  Walk both(100);
  EXPECT_EQ(both.stance(own::stance_foot), 0u) << "the first of those that are named";
}

TEST(ABipedThatIsPutAnywhere, WithSolesAtAnAngleStandsOnTheirEdgesAlike) {
  Walk w(100, {}, {{"left_ankle", 0.2}, {"right_ankle", -0.2}});
  EXPECT_EQ(w.stance(own::stance_is_flush), 0u) << "flat on either sole the other would be in the ground";
  EXPECT_LT(w.base().orientation.vec().norm(), 1e-9) << "their mean looks down";
  w.run_for(0.05);
  EXPECT_NEAR(std::min(lowest_corner(w, "left_foot"), lowest_corner(w, "right_foot")), 0, 1e-9);
}

TEST(ABipedThatIsPutAnywhere, WalksOnFromThere) {
  const Compass legs;
  Walk a(100, {}, legs.start()), b(100, {}, legs.start());
  Pose to;
  for (int k = 1; k <= 120; ++k) {
    legs.set(a, k * 0.01);
    legs.set(b, k * 0.01);
    if (k == 60) {
      to = Pose{{3, -2, 0}, from_rpy(0, 0, 1)};
      b.place({b.robot.base(), to * b.base()});
    }
    a.run_for(0.01);
    b.run_for(0.01);
  }
  const Pose expected = to * a.base();
  EXPECT_LT((b.base().position - expected.position).norm(), 1e-9);
  EXPECT_LT(b.base().orientation.angularDistance(expected.orientation), 1e-9);
}

/// A walker with two motions, which changes to the second one and back.
struct TwoLevels : test::Scene {
  const RobotView& robot;
  explicit TwoLevels(const std::string& other)
      : robot((add_ground(), add("r", walker({flat_sole()}), {{0, 0, leg_length}, Quat::Identity()}))) {
    Parameters of_other;
    for (const Parameter& p : test::plugins().algorithm(other).description->parameters)
      if (p.name == "joints") of_other["joints"] = std::string("velocity");
    use("motion.biped", 1000, {{&robot, robot.base(), 0}},
        {{"feet", Names{"left_foot", "right_foot"}}, {"joints", std::string("velocity")}});
    use(other, 1000, {{&robot, robot.base(), 1}}, of_other);
    set_levels(robot, {"biped", "other"}, 0);
    use_contacts();
    build();
  }
  void go(std::int32_t level, double seconds) {
    world().value(robot.base(), keys::motion_level_target) = level;
    run_for(seconds);
  }
};

std::vector<std::string> other_motions() {
  std::vector<std::string> ids;
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.kind == "motion" && (o.id == "motion.point" || (o.features && (*o.features & feature_forces) != 0)))
      ids.push_back(o.id);
  return ids;
}

class HandOverOfABiped : public ::testing::TestWithParam<std::string> {};

TEST_P(HandOverOfABiped, ToAnotherMotionAndBackKeepsItOnItsFeet) {
  TwoLevels s(GetParam());
  s.go(0, 0.1);
  const Pose before = s.pose(s.robot);
  s.go(1, 0.002);
  EXPECT_LT((s.pose(s.robot).position - before.position).norm(), 1e-3);
  EXPECT_EQ(s.world().value("r/left_foot", keys::foot_contact), 0u) << "the other motion does not tell it";
  s.pose(s.robot) = {{0.5, 0.3, 0.4}, from_rpy(0.4, 1.2, 0.1)};  // it has fallen
  s.go(1, 0.002);
  s.go(0, 0.002);
  EXPECT_NEAR(s.pose(s.robot).position.z(), leg_length, 1e-6) << "engines let joints give a little";
  EXPECT_NEAR((s.pose(s.robot).orientation * Vec3::UnitZ()).z(), 1, 1e-12) << "put on its feet";
  EXPECT_EQ(s.world().value("r/left_foot", keys::foot_contact), 1u);
}

TEST_P(HandOverOfABiped, GoesOnFromASnapshotToTheSameBits) {
  TwoLevels s(GetParam());
  s.world().value("r/left_yaw", keys::joint_velocity_target) = 0.2;
  s.go(1, 0.02);
  s.go(0, 0.02);
  const Snapshot middle = s.snapshot();
  s.go(1, 0.01);
  s.go(0, 0.02);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.go(1, 0.01);
  s.go(0, 0.02);
  EXPECT_EQ(s.state_hash(), end);
}

INSTANTIATE_TEST_SUITE_P(Biped, HandOverOfABiped, ::testing::ValuesIn(other_motions()),
                         [](const auto& test) { return test.param.substr(7); });

TEST(BipedWalker, WalksToTheSameBitsAfterAResetAndASnapshot) {
  const Compass legs;
  Walk w(100, {{"interpolate", 0.02}}, legs.start());
  const auto walk = [&](int from, int to) {
    for (int k = from; k <= to; ++k) {
      legs.set(w, k * 0.01);
      w.run_for(0.01);
    }
    return w.state_hash();
  };
  const std::uint64_t middle = walk(1, 57);
  const Snapshot kept = w.snapshot();
  const std::uint64_t end = walk(58, 150);
  w.restore(kept);
  EXPECT_EQ(walk(58, 150), end);
  w.reset();
  EXPECT_EQ(walk(1, 57), middle);
}

TEST(BipedWalker, DoesOnlyWhatItHasDeclared) {
  const Compass legs;
  Walk plain(100, {}, legs.start()), checked(100, {}, legs.start());
  checked.verify_access();
  for (int k = 1; k <= 90; ++k)
    for (Walk* w : {&plain, &checked}) {
      legs.set(*w, k * 0.01);
      w->run_for(0.01);
    }
  EXPECT_EQ(plain.state_hash(), checked.state_hash());
}

}  // namespace
}  // namespace muro::biped::testing
