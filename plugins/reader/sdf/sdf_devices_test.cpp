// SPDX-License-Identifier: MIT
// Sensors, plugins and flags of models as subsystems of their robots.
#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

constexpr char lidar[] =
    "<sensor name='scan' type='gpu_lidar'><pose>0 0 0.1 0 0 0</pose><update_rate>10</update_rate><lidar><scan>"
    "<horizontal><samples>4</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>"
    "<range><min>0.1</min><max>9</max></range><noise><type>gaussian</type><stddev>0.02</stddev></noise></lidar>"
    "</sensor>";
constexpr char scan[] = "offset: [0, 0, 0.1], rays: 4, min_angle: -1, max_angle: 1, min_range: 0.1, max_range: 9}";

Lines subsystems_of(const RobotTree& tree) {
  Lines texts;
  for (const auto& s : tree.subsystems()) texts.push_back(concat(s.line, ":", s.column, " ", s.text));
  return texts;
}

TEST(SdfDevices, ASensorIsASubsystemOfTheRobotWithItsErrors) {
  const Robot robot = robot_of(model("<link name='a'>" + inertial() + "\n" + lidar + "</link>"));
  EXPECT_EQ(subsystems_of(robot.tree),
            (Lines{concat("4:1 scan: {use: laser.embree, on: a, rate: 10, ", scan),
                   "4:1 scan_error: {use: sensor.error, on: scan, of: ranges, sigma: 0.02}"}));
  ASSERT_EQ(robot.problems.size(), 1U);
  EXPECT_TRUE(robot.problems[0].starts_with("note 4:1 sensor `scan` becomes `scan: {use: laser.embree"));
}

TEST(SdfDevices, OfAnIncludedModelHaveItsNameBeforeTheirs) {
  const test::ScratchFolder folder;
  folder.file("mast.sdf", "<sdf version='1.9'><model name='mast'><link name='top'>" + inertial() + "\n" + lidar +
                              "</link></model></sdf>");
  const Robot robot =
      robot_of(model("<link name='a'>" + inertial() + "</link>" +
                     "<include><uri>mast.sdf</uri><name>left</name></include><include><uri>mast.sdf</uri><name>right</"
                     "name></include>"
                     "<joint name='l' type='fixed'><parent>a</parent><child>left::top</child></joint>"
                     "<joint name='r' type='fixed'><parent>a</parent><child>right::top</child></joint>"),
               folder.path(""));
  EXPECT_EQ(subsystems_of(robot.tree),
            (Lines{concat("0:0 left.scan: {use: laser.embree, on: left.top, rate: 10, ", scan),
                   "0:0 left.scan_error: {use: sensor.error, on: left.scan, of: ranges, sigma: 0.02}",
                   concat("0:0 right.scan: {use: laser.embree, on: right.top, rate: 10, ", scan),
                   "0:0 right.scan_error: {use: sensor.error, on: right.scan, of: ranges, sigma: 0.02}"}));
  ASSERT_EQ(robot.problems.size(), 2U);
  EXPECT_NE(robot.problems[0].find("mast.sdf:2:1: sensor `scan` becomes `left.scan: {"), std::string::npos)
      << robot.problems[0];
}

TEST(SdfDevices, ADriveFollowsTheTwistAndOtherPluginsAreListed) {
  const Robot robot = robot_of(model(
      "<link name='a'>" + inertial() + "</link><link name='b'>" + inertial() + "</link><link name='c'>" + inertial() +
      "</link>" + joint("l", "revolute", "a", "b", axis("0 1 0")) + joint("r", "revolute", "a", "c", axis("0 1 0")) +
      "\n<plugin filename='ignition-gazebo-diff-drive-system' name='ignition::gazebo::systems::DiffDrive'>"
      "<left_joint>l</left_joint><right_joint>r</right_joint><wheel_separation>1.2</wheel_separation>"
      "<wheel_radius>0.3</wheel_radius><topic>cmd</topic></plugin>\n<plugin filename='lights'/>"));
  EXPECT_EQ(subsystems_of(robot.tree),
            Lines{"4:1 drive: {use: drive.differential, left: [l], right: [r], wheel_radius: 0.3, track: 1.2}"});
  EXPECT_EQ(without_notes(robot.problems),
            Lines{"warning 5:1 <plugin filename=`lights`> is left out: plugins of Gazebo are not run; a scenario names "
                  "algorithms and controllers"});
}

TEST(SdfDevices, GravityThatIsOffAndSelfCollisionAreSubsystems) {
  const Robot robot = robot_of(model("<link name='a'>" + inertial() + "<gravity>false</gravity></link><link name='b'>" +
                                     inertial() + "<gravity>1</gravity><self_collide>true</self_collide></link>" +
                                     joint("j", "revolute", "a", "b", axis("0 1 0"))));
  ASSERT_EQ(robot.tree.subsystems().size(), 2U);
  EXPECT_EQ(robot.tree.subsystems()[0].text, "gravity_compensation: {use: drive.gravity_compensation, links: [a]}");
  EXPECT_EQ(robot.tree.subsystems()[1].text, "motion: {self_collision: true}");
  EXPECT_EQ(without_notes(robot.problems), Lines{});
}

TEST(SdfDevices, AFlagThatIsNoneIsToldAndLeftOut) {
  const Robot robot = robot_of(model("<link name='a'>" + inertial() + "\n<gravity>up</gravity></link>"));
  EXPECT_EQ(robot.problems,
            Lines{"warning 4:1 <link> `a`: <gravity> `up` is none of true, false, 1, 0; it is left out"});
  EXPECT_TRUE(robot.tree.subsystems().empty());
}

}  // namespace
}  // namespace muro::sdf
