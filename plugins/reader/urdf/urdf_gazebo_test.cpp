// SPDX-License-Identifier: MIT
// <gazebo> blocks, in the terms of SDFormat's specification (sdformat.org/spec) and of sdformat's parser_urdf.
#include <gtest/gtest.h>

#include <algorithm>

#include "recording_builder.hpp"

namespace muro::urdf {
namespace {

using Lines = std::vector<std::string>;

/// Returns a robot of two links and a hinge `j`, followed by `gazebo` from line 2 on.
RecordingBuilder with(const std::string& gazebo) {
  return recorded(concat("<robot name='r'>", body_a, link_b,
                         "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>\n", gazebo,
                         "</robot>"));
}

Lines subsystems_of_sensor(const std::string& sensor) {
  return with("<gazebo reference='b'>" + sensor + "</gazebo>").subsystems;
}

TEST(UrdfGazebo, ALidarIsALaserWithItsAnglesRangesRatePoseAndNoise) {
  const RecordingBuilder robot = with(
      "<gazebo reference='b'>\n<sensor name='scan' type='gpu_ray'><pose>0.1 0 0.2 0 0 1.5</pose>"
      "<update_rate>40</update_rate><ray><scan><horizontal><samples>360</samples><resolution>2</resolution>"
      "<min_angle>-1</min_angle><max_angle>1</max_angle></horizontal><vertical><samples>16</samples>"
      "<min_angle>-0.25</min_angle><max_angle>0.25</max_angle></vertical></scan>"
      "<range><min>0.1</min><max>30</max><resolution>0.01</resolution></range>"
      "<noise><type>gaussian</type><mean>0.02</mean><stddev>0.005</stddev></noise></ray></sensor></gazebo>");
  EXPECT_EQ(robot.subsystems,
            (Lines{"scan: {use: laser.embree, on: b, rate: 40, offset: [0.1, 0, 0.2], rpy: [0, 0, 1.5], rays: 720, "
                   "min_angle: -1, max_angle: 1, rows: 16, min_elevation: -0.25, max_elevation: 0.25, min_range: 0.1, "
                   "max_range: 30}",
                   "scan_error: {use: sensor.error, on: scan, of: ranges, sigma: 0.005, bias: 0.02, resolution: "
                   "0.01}"}));
  EXPECT_EQ(robot.subsystem_places, (std::vector<std::int32_t>{3, 1, 3, 1}));
  ASSERT_EQ(robot.problems.size(), 1U);
  EXPECT_TRUE(robot.problems[0].starts_with("note 3:1 sensor `scan` becomes `scan: {use: laser.embree"))
      << robot.problems[0];
}

TEST(UrdfGazebo, ACameraHasItsImageLensClipsAndNoiseAndADepthCameraDepth) {
  const std::string camera =
      "<camera><pose>0 0 0.1 0 0 0</pose><horizontal_fov>1.2</horizontal_fov><image><width>320</width>"
      "<height>240</height></image><clip><near>0.1</near><far>50</far></clip><distortion><k1>0.1</k1><k2>-0.2</k2>"
      "<k3>0.3</k3><p1>0.01</p1><p2>0.02</p2></distortion><noise><type>gaussian</type><mean>0</mean>"
      "<stddev>0.007</stddev></noise></camera>";
  const std::string image = "horizontal_fov: 1.2, near: 0.1, far: 50, ",
                    lens = "distortion: [0.1, -0.2, 0.01, 0.02, 0.3], noise: 0.007}";
  const std::string begin = "{use: camera.opengl, on: b, rate: 10, offset: [0, 0, 0.1], width: 320, height: 240, ";
  EXPECT_EQ(
      subsystems_of_sensor("<sensor name='eye' type='camera'><update_rate>10</update_rate>" + camera + "</sensor>"),
      Lines{"eye: " + begin + image + lens});
  EXPECT_EQ(
      subsystems_of_sensor("<sensor name='eye' type='depth'><update_rate>10</update_rate>" + camera + "</sensor>"),
      Lines{"eye: " + begin + image + "rgb: false, depth: true, " + lens});
}

TEST(UrdfGazebo, ANoiseOfAnImuIsAnErrorOfItsReadingsWithBiasAndDrift) {
  EXPECT_EQ(subsystems_of_sensor(
                "<sensor name='imu' type='imu'><update_rate>200</update_rate><imu><angular_velocity>"
                "<x><noise type='gaussian'><mean>0</mean><stddev>2e-4</stddev><bias_mean>7.5e-6</bias_mean>"
                "<bias_stddev>8e-7</bias_stddev></noise></x></angular_velocity><linear_acceleration>"
                "<x><noise type='gaussian'><stddev>0.017</stddev><dynamic_bias_stddev>0.002</dynamic_bias_stddev>"
                "<dynamic_bias_correlation_time>300</dynamic_bias_correlation_time></noise></x>"
                "<y><noise type='gaussian'><stddev>0.017</stddev><dynamic_bias_stddev>0.002</dynamic_bias_stddev>"
                "<dynamic_bias_correlation_time>300</dynamic_bias_correlation_time></noise></y>"
                "<z><noise type='gaussian'><stddev>0.017</stddev><dynamic_bias_stddev>0.002</dynamic_bias_stddev>"
                "<dynamic_bias_correlation_time>300</dynamic_bias_correlation_time></noise></z>"
                "</linear_acceleration></imu></sensor>"),
            (Lines{"imu: {use: sensor.imu, on: b, rate: 200}",
                   "imu_gyro_error: {use: sensor.error, on: imu, of: angular_velocity, sigma: [2e-04, 0, 0], bias: "
                   "[7.5e-06, 0, 0], turn_on_bias_tolerance: [2.4e-06, 0, 0]}",
                   "imu_accelerometer_error: {use: sensor.error, on: imu, of: linear_acceleration, sigma: 0.017, "
                   "gauss_markov_density: 0.002, gauss_markov_time: 300}"}));
}

TEST(UrdfGazebo, AContactAGpsAndAForceTorqueSensorAreThoseOfMuro) {
  const std::string link =
      "<link name='c'><collision><geometry><sphere radius='1'/></geometry></collision></link>"
      "<joint name='k' type='fixed'><parent link='b'/><child link='c'/></joint>";
  EXPECT_EQ(with(link + "<gazebo reference='c'><sensor name='bump' type='contact'><update_rate>50</update_rate>"
                        "<contact><collision>c_collision</collision></contact></sensor></gazebo>")
                .subsystems,
            Lines{"bump: {use: sensor.bumper, on: c, rate: 50}"});
  EXPECT_EQ(subsystems_of_sensor("<sensor name='gps' type='gps'><pose>0 0 1 0 0 0</pose><update_rate>5</update_rate>"
                                 "<gps><position_sensing><horizontal><noise type='gaussian'><stddev>0.5</stddev>"
                                 "</noise></horizontal></position_sensing></gps></sensor>"),
            (Lines{"gps: {use: sensor.gps, on: b, rate: 5, offset: [0, 0, 1]}",
                   "gps_position_error: {use: sensor.error, on: gps, of: gps.position, sigma: [0.5, 0.5, 0]}"}));
  EXPECT_EQ(with("<gazebo reference='j'><sensor name='ft' type='force_torque'><update_rate>100</update_rate>"
                 "</sensor></gazebo>")
                .subsystems,
            Lines{"ft: {use: sensor.force_torque, on: b, rate: 100}"});
}

TEST(UrdfGazebo, ASensorRunsOnDemandAndHasANameOfItsOwn) {
  EXPECT_EQ(subsystems_of_sensor("<sensor name='b' type='imu'/>"),
            Lines{"b_sensor: {use: sensor.imu, on: b, rate: on_demand}"});
}

TEST(UrdfGazebo, DriveMechanismsOfVehiclesAreDrives) {
  const std::string wheels =
      "<joint name='k' type='continuous'><parent link='a'/><child link='c'/></joint>"
      "<link name='c'/>";
  EXPECT_EQ(with(wheels + "<gazebo><plugin name='d' filename='libgazebo_ros_diff_drive.so'><leftJoint>j</leftJoint>"
                          "<rightJoint>k</rightJoint><wheelSeparation>0.4</wheelSeparation>"
                          "<wheelDiameter>0.2</wheelDiameter></plugin></gazebo>")
                .subsystems,
            Lines{"drive: {use: drive.differential, left: [j], right: [k], wheel_radius: 0.1, track: 0.4}"});
  EXPECT_EQ(with(wheels + "<gazebo><plugin name='gz::sim::systems::DiffDrive' filename='gz-sim-diff-drive-system'>"
                          "<left_joint>j</left_joint><right_joint>k</right_joint><wheel_radius>0.1</wheel_radius>"
                          "</plugin></gazebo>")
                .subsystems,
            Lines{"drive: {use: drive.differential, left: [j], right: [k], wheel_radius: 0.1}"});
  EXPECT_EQ(with(wheels + "<gazebo><plugin name='a' filename='libgazebo_ros_ackermann_drive.so'>"
                          "<left_steering_joint>j</left_steering_joint><rear_left_joint>k</rear_left_joint>"
                          "<max_steer>0.6</max_steer></plugin></gazebo>")
                .subsystems,
            Lines{"drive: {use: drive.ackermann, steering: [j], driven: [k], max_steering_angle: 0.6}"});
}

TEST(UrdfGazebo, ADriveOfAJointThatIsNotThereIsLeftOut) {
  const RecordingBuilder robot = with(
      "<gazebo><plugin name='d' filename='libgazebo_ros_diff_drive.so'><leftJoint>j</leftJoint>"
      "<rightJoint>wheel</rightJoint></plugin></gazebo>");
  EXPECT_TRUE(robot.subsystems.empty());
  EXPECT_EQ(robot.problems, Lines{"warning 2:9 plugin `libgazebo_ros_diff_drive.so` is left out: it names `wheel`, "
                                  "which is no joint that moves"});
}

TEST(UrdfGazebo, GravityStaticAndSelfCollisionAreSubsystemsToo) {
  const RecordingBuilder robot = with(
      "<gazebo reference='b'><turnGravityOff>true</turnGravityOff></gazebo>\n"
      "<gazebo reference='a'><gravity>1</gravity><selfCollide>1</selfCollide></gazebo>\n"
      "<gazebo><static>true</static></gazebo>");
  EXPECT_EQ(robot.subsystems, (Lines{"motion: {base: fixed, self_collision: true}",
                                     "gravity_compensation: {use: drive.gravity_compensation, links: [b]}"}));
  EXPECT_EQ(robot.problems.size(), 3U);
}

TEST(UrdfGazebo, ASpringIsAPositionDriveTowardsItsReference) {
  const Lines calls =
      with("<gazebo reference='j'><springStiffness>20</springStiffness><springReference>0.5</springReference></gazebo>")
          .calls;
  EXPECT_EQ(calls, (Lines{"base a", "revolute j about 1 0 0", "set joint.drive 1", "set joint.drive.stiffness 20",
                          "set joint.drive.damping 0", "set joint.position.target 0.5", "body b"}));
}

TEST(UrdfGazebo, WhatHasNoCounterpartIsListedWithItsLines) {
  EXPECT_EQ(
      with("<gazebo reference='a'><kp>1e6</kp><material>Gazebo/Red</material><dampingFactor>1</dampingFactor></gazebo>"
           "\n<gazebo reference='b'><kp>1e6</kp><wings>2</wings></gazebo>\n"
           "<gazebo><plugin name='c' filename='libgazebo_ros_control.so'/><sky/></gazebo>\n"
           "<gazebo reference='b'><sensor name='s' type='sonar'/></gazebo>")
          .problems,
      (Lines{"note 2:23 <kp> in <gazebo> is left out (also in line 3): the stiffness of contacts and joints is a "
             "matter of the algorithms in the scenario",
             "note 2:35 <material> in <gazebo> is left out: materials of Gazebo's scripts are not read; write "
             "<material> with a <color>",
             "warning 2:66 <dampingFactor> in <gazebo> is left out: damping of bodies is a parameter of the motion, "
             "where it has one",
             "warning 3:35 <wings> in <gazebo> is left out: it has no counterpart in a link",
             "warning 4:9 <plugin filename=`libgazebo_ros_control.so`> is left out: plugins of Gazebo are not run; a "
             "scenario names algorithms and controllers",
             "warning 4:63 <sky> in <gazebo> is left out: it has no counterpart in a robot",
             "warning 5:23 <sensor type=`sonar`> is left out: there is no such sensor; `muro plugins list` shows those "
             "that a scenario can have"}));
}

TEST(UrdfGazebo, ValuesThatCannotBeAreTheNearestOrLeftOutAndTheSensorStays) {
  const RecordingBuilder robot = with(
      "<gazebo reference='b'><sensor name='s' type='ray'><update_rate>-1</update_rate><ray><scan><horizontal>"
      "<samples>0</samples><min_angle>x</min_angle><max_angle>1e9</max_angle></horizontal></scan>"
      "<range><min>nan</min><max>inf</max></range></ray></sensor></gazebo>");
  EXPECT_EQ(robot.subsystems, Lines{"s: {use: laser.embree, on: b, rate: on_demand, rays: 1, min_angle: 0, max_angle: "
                                    "6.283185307179586, max_range: 1e+06}"});
  EXPECT_EQ(robot.problems.size(), 6U) << "five values and what the sensor becomes";
}

TEST(UrdfGazebo, AScanEndsOnceRoundAndCamerasHaveDefaults) {
  EXPECT_EQ(
      subsystems_of_sensor("<sensor name='s' type='ray'><ray><scan><horizontal><samples>360</samples>"
                           "<max_angle>6.28319</max_angle></horizontal></scan></ray></sensor>"),
      Lines{"s: {use: laser.embree, on: b, rate: on_demand, rays: 360, min_angle: 0, max_angle: 6.283185307179586}"});
  EXPECT_EQ(subsystems_of_sensor("<sensor name='c' type='camera'><camera/></sensor>"),
            Lines{"c: {use: camera.opengl, on: b, rate: on_demand, width: 320, height: 240, near: 0.1, far: 100}"});
}

TEST(UrdfGazebo, ARobotHasOneDriveAndNamesThatNothingElseHas) {
  const std::string drive =
      "<plugin filename='libgazebo_ros_diff_drive.so'><leftJoint>j</leftJoint>"
      "<rightJoint>j</rightJoint></plugin>";
  const RecordingBuilder robot = with("<gazebo>" + drive + "\n" + drive + "</gazebo>\n<gazebo reference='b'>" +
                                      "<gravity>0</gravity><sensor name='drive' type='imu'/></gazebo>");
  EXPECT_EQ(robot.subsystems, (Lines{"drive: {use: drive.differential, left: [j], right: [j]}",
                                     "drive_sensor: {use: sensor.imu, on: b, rate: on_demand}",
                                     "gravity_compensation: {use: drive.gravity_compensation, links: [b]}"}));
  EXPECT_EQ(robot.problems[1],
            "warning 3:1 plugin `libgazebo_ros_diff_drive.so` is left out: the robot has a drive already");
}

TEST(UrdfGazebo, ASpringOfAJointThatFollowsIsLeftOut) {
  const RecordingBuilder robot = recorded(
      concat("<robot name='r'>", body_a, link_b, "<link name='c'/><joint name='j' type='continuous'><parent link='a'/>",
             "<child link='b'/></joint><joint name='k' type='continuous'><parent link='a'/><child link='c'/>",
             "<mimic joint='j'/></joint><gazebo reference='k'><springStiffness>2</springStiffness></gazebo></robot>"));
  EXPECT_EQ(std::count(robot.calls.begin(), robot.calls.end(), "set joint.drive 1"), 0);
}

TEST(UrdfGazebo, AScanOfTooManyRaysAndAPoseInAnotherFrameAreLeftOut) {
  for (const char* const inside :
       {"<ray><scan><horizontal><samples>1000000</samples></horizontal><vertical><samples>4000</samples></vertical>"
        "</scan></ray>",
        "<pose relative_to='a'>0 0 0 0 0 0</pose><ray/>"}) {
    const RecordingBuilder robot =
        with(concat("<gazebo reference='b'><sensor name='s' type='ray'>", inside, "</sensor></gazebo>"));
    EXPECT_TRUE(robot.subsystems.empty());
    EXPECT_EQ(robot.problems.size(), 1U);
  }
}

}  // namespace
}  // namespace muro::urdf
