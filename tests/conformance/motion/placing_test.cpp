// SPDX-License-Identifier: MIT
// Robots that are placed elsewhere between steps, in every motion.
#include <gtest/gtest.h>

#include "tests/conformance/motion/case.hpp"
#include "tests/conformance/team.hpp"
#include "tests/support/complaint.hpp"

namespace muro::conformance {
namespace {

std::vector<std::string> motions_of_blocks() {
  std::vector<std::string> some;
  for (const std::string& id : motions())
    if ((description_of(id).features & feature_contact) != 0 && (description_of(id).features & feature_forces) != 0)
      some.push_back(id);
  return some;
}

class ABlock : public testing::TestWithParam<std::string> {};

TEST_P(ABlock, ThatIsPutElsewhereWhileItSlidesStandsThere) {
  Trial t(GetParam());
  t.add_ground(0.5);
  const RobotView& r =
      t.add("block", block(2, {0.4, 0.4, 0.2}, 0.5), {{0, 0, 0.1}, Quat::Identity()}, {{1, 0, 0}, {0, 0, 0}});
  t.start();
  t.run_for(0.1);
  ASSERT_GT(t.twist(r).linear.x(), 0.3) << "it slides";
  const Pose there{{-7, 3, t.pose(r).position.z()}, from_rpy(0, 0, 1)};
  t.place({r.base(), there});
  t.run_for(0.5);
  EXPECT_LT((t.pose(r).position - there.position).norm(), 1e-3);
  EXPECT_LT(t.twist(r).linear.norm(), 1e-2);
  EXPECT_LT(t.pose(r).orientation.angularDistance(there.orientation), 1e-3);
}

TEST_P(ABlock, ThatIsThrownFliesAParabola) {
  Trial t(GetParam());
  t.add_ground(0.5);
  const RobotView& r = t.add("block", block(2, {0.4, 0.4, 0.2}, 0.5), {{0, 0, 0.1}, Quat::Identity()});
  t.start();
  t.run_for(0.3);
  t.place({r.base(), {{4, 4, 3}, Quat::Identity()}, {{2, 0, 1}, Vec3::Zero()}});
  t.run_for(0.4);
  EXPECT_NEAR(t.pose(r).position.x(), 4 + 2 * 0.4, 2e-3);
  EXPECT_NEAR(t.pose(r).position.z(), 3 + 1 * 0.4 - g * 0.4 * 0.4 / 2, 4e-3);
  EXPECT_NEAR(t.twist(r).linear.z(), 1 - g * 0.4, 2e-2);
}

TEST_P(ABlock, ThatIsPutBackWhereItWasGoesOnAsInAnotherRun) {
  const auto end = [&](bool is_placed) {
    Trial t(GetParam());
    t.add_ground(0.5);
    const RobotView& r =
        t.add("block", block(2, {0.4, 0.4, 0.2}, 0.5), {{0, 0, 2}, Quat::Identity()}, {{1, 0, 0}, {0, 0, 0}});
    t.start();
    t.run_for(0.2);
    if (is_placed) t.place({r.base(), t.pose(r), t.twist(r)});
    t.run_for(0.2);
    return t.pose(r).position;
  };
  EXPECT_LT((end(true) - end(false)).norm(), 1e-6);
}

class AVehicle : public testing::TestWithParam<std::string> {};

TEST_P(AVehicle, ThatIsPutElsewhereDrivesOnFromThere) {
  test::Team team(GetParam());
  const RobotView& rover = *team.rovers[2];
  team.run_for(0.5);
  Pose there = team.pose(rover);
  there.position += Vec3(30, -20, 0);
  team.place({rover.base(), there});
  team.run_for(0.2);
  EXPECT_LT((team.pose(rover).position - there.position).norm(), 0.2) << "it is there";
  EXPECT_NEAR(team.pose(rover).position.z(), there.position.z(), 0.02) << "it neither falls nor jumps";
  const Vec3 before = team.pose(rover).position;
  team.run_for(1);
  EXPECT_NEAR((team.pose(rover).position - before).norm(), 0.5, 0.15) << "at the commanded 0.5 m/s";
  EXPECT_LT((team.pose(*team.rovers[0]).position - Vec3(0, 0, 0)).norm(), 2) << "the others drive on where they are";
}

TEST_P(AVehicle, GoesOnToTheSameBitsWhenItIsPutThereAgain) {
  const auto hash = [&] {
    test::Team team(GetParam());
    team.run_for(0.2);
    Pose there = team.pose(*team.rovers[1]);
    there.position += Vec3(3, -20, 0);
    team.place({team.rovers[1]->base(), there, {{0.3, 0, 0}, {0, 0, 0.1}}});
    team.run_for(0.2);
    return team.state_hash();
  };
  EXPECT_EQ(hash(), hash());
}

TEST(Placing, RefusesWhatCannotBe) {
  test::Team team("motion.point");
  const auto complaint = [&](const Placement& p) { return test::complaint_of([&] { team.place(p); }); };
  const ObjectId rover = team.rovers[0]->base();
  EXPECT_SAYS(complaint({team.world().object("block_0"), {}}), "`block_0` does not move");
  EXPECT_SAYS(complaint({team.world().object("rover_0/laser_link"), {}}),
              "a robot is put by its base, `rover_0/base_link`");
  EXPECT_SAYS(complaint({ObjectId{99999}, {}}), "there is no object 99999");
  EXPECT_SAYS(complaint({rover, {{std::nan(""), 0, 0}, Quat::Identity()}}), "has a coordinate");
  EXPECT_SAYS(complaint({rover, {{0, 0, 0}, Quat(2, 0, 0, 0)}}), "no unit quaternion");
  EXPECT_SAYS(complaint({rover, {}, {{1e9, 0, 0}, {0, 0, 0}}}), "has a velocity that");
  team.set_overlap_check([](const Placement&) { return std::string("`wall` by 0.2 m"); });
  EXPECT_SAYS(complaint({rover, {}}), "would overlap `wall` by 0.2 m there; put it elsewhere, or force it");
  EXPECT_EQ(complaint({rover, {}, {}, true}), "no complaint");
}

INSTANTIATE_TEST_SUITE_P(Conformance, ABlock, testing::ValuesIn(motions_of_blocks()), test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, AVehicle, testing::ValuesIn(motions()), test::name_of);

}  // namespace
}  // namespace muro::conformance
