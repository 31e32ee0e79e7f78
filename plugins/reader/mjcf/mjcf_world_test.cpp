// SPDX-License-Identifier: MIT
#include "reading_testing.hpp"

namespace muro::mjcf {
namespace {

const std::string yard = R"(<mujoco><option gravity="0 0 -3.7"/>
<default><geom friction="0.5"/></default>
<worldbody>
<geom name="floor" type="plane" size="5 5 1" friction="0.9"/>
<geom type="box" pos="1 2 3" euler="0 0 90" size="1 2 3"/>
<body name="table" pos="0 3 0"><geom type="box" size="1 1 0.1" pos="0 0 1"/>
 <body pos="0.5 0 0"><geom type="cylinder" size="0.1 0.5"/></body></body>
<body name="ball" pos="0 0 2"><freejoint/><geom size="0.2"/></body>
<body name="arm" pos="2 0 0"><geom type="box" size="0.1 0.1 0.1"/>
 <body name="upper" pos="0 0 0.2"><joint name="lift" axis="0 1 0"/><geom type="capsule" size="0.05 0.2"/></body></body>
<body name="odd"><joint name="knob" type="ball"/><geom size="0.1"/></body>
</worldbody></mujoco>)";

TEST(MjcfWorld, GeomsAreSceneryAndTreesAreModels) {
  WorldModel world;
  read_world_text(yard, "/nowhere/yard.xml", world);
  world.close();
  EXPECT_EQ(world.gravity(), Vec3(0, 0, -3.7));
  ASSERT_EQ(world.scenery().size(), 3u);
  EXPECT_EQ(world.scenery()[0].name, "floor");
  EXPECT_EQ(world.scenery()[0].collisions[0].kind, ShapeKind::plane);
  EXPECT_EQ(world.scenery()[0].collisions[0].surface.friction, 0.9);
  EXPECT_EQ(world.scenery()[1].name, "geom_2");
  EXPECT_TRUE(near(world.scenery()[1].pose, {{1, 2, 3}, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()))}));
  EXPECT_TRUE(near(world.scenery()[1].collisions[0].origin, {}));
  EXPECT_EQ(world.scenery()[1].collisions[0].surface.friction, 0.5);
  EXPECT_EQ(world.scenery()[2].name, "table");
  EXPECT_TRUE(near(world.scenery()[2].pose, {{0, 3, 0}, Quat::Identity()}));
  ASSERT_EQ(world.scenery()[2].collisions.size(), 2u);
  EXPECT_TRUE(near(world.scenery()[2].collisions[1].origin, {{0.5, 0, 0}, Quat::Identity()}));
  ASSERT_EQ(world.models().size(), 3u);
  EXPECT_EQ(world.models()[0].name, "ball");
  EXPECT_EQ(world.models()[0].pose.position, Vec3(0, 0, 2));
  EXPECT_EQ(world.models()[1].name, "arm");
  EXPECT_EQ(world.models()[1].pose.position, Vec3(2, 0, 0));
}

TEST(MjcfWorld, TheLargerFrictionCountsAlsoWhereNothingMoves) {
  for (const char* text : {yard.c_str(), "<mujoco><worldbody><geom type='plane' size='5 5 1'/></worldbody></mujoco>"}) {
    WorldModel world;
    read_world_text(text, "/nowhere/yard.xml", world);
    EXPECT_EQ(world.friction_rule(), FrictionRule::max) << text;
  }
}

TEST(MjcfWorld, OneBadModelLeavesTheOthers) {
  WorldModel world;
  read_world_text(yard, "/nowhere/yard.xml", world);
  world.close();
  EXPECT_TRUE(world.models()[0].tree.usable());
  EXPECT_TRUE(world.models()[1].tree.usable());
  EXPECT_FALSE(world.models()[2].tree.usable());
  EXPECT_TRUE(has_line(lines_of(world.models()[2].tree.problems()),
                       "error 11: joint `knob` of body `odd` is a ball, which robots do not have; write three hinges "
                       "about x, y and z in its place"))
      << joined(lines_of(world.models()[2].tree.problems()));
}

TEST(MjcfWorld, AsAModelTheFirstTreeThatCanMoveIsTheRobot) {
  const Robot robot = robot_of(yard);
  EXPECT_EQ(robot.links(), Lines{"ball"});
  EXPECT_TRUE(
      has_line(robot.problems,
               "note 6: the robot is body `ball` with what hangs on it; `floor`, `geom 2 of worldbody`, `table`, "
               "`arm`, `odd` of <worldbody> are left out: `world: {file: ...}` reads all of a file"))
      << joined(robot.problems);
}

TEST(MjcfWorld, GravityThatTheFileDisablesIsNone) {
  WorldModel world;
  read_world_text("<mujoco><option><flag gravity='disable'/></option></mujoco>", "/nowhere/yard.xml", world);
  EXPECT_EQ(world.gravity(), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace muro::mjcf
