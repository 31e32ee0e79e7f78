// SPDX-License-Identifier: MIT
// Subsystems that a model has besides its bodies, and settings of the scenario for them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr char model[] = R"(<robot name="cart">
<link name="base">
  <inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision>
</link>
<link name="mast"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="base"/><child link="mast"/><axis xyz="0 0 1"/>
  <limit lower="-3" upper="3" effort="100" velocity="100"/></joint>
<gazebo reference="hinge"><springStiffness>3.6</springStiffness><springReference>0.5</springReference></gazebo>
<gazebo reference="base">
  <sensor name="lidar" type="ray"><update_rate>20</update_rate><pose>0 0 0.5 0 0 0</pose>
    <ray><scan><horizontal><samples>5</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
    <range><max>50</max></range>
    <noise><type>gaussian</type><stddev>0.01</stddev></noise></ray></sensor>
</gazebo>
<gazebo><static>true</static></gazebo>
</robot>)";

class ModelSubsystems : public testing::Test {
 protected:
  /// `more`: further lines of the robot.
  BuiltScenario built(const std::string& more, const std::string& motion = "motion.articulated") {
    scratch_.file("cart.urdf", model);
    const std::string file = scratch_.file("cart.yaml",
                                           "world: {objects: {wall: {shape: {box: [1, 9, 9]}, at: {x: 5, z: 0}}}}\n"
                                           "robots:\n  cart:\n    model: cart.urdf\n" +
                                               std::string(more.find("place:") == more.npos ? "    at: {z: 1}\n" : "") +
                                               "    motion: {use: " + motion + ", rate: 1000}\n" + more);
    return build(read_scenario(file, {}), test::plugins());
  }
  static std::vector<std::string> uses(const BuiltScenario& b) {
    std::vector<std::string> uses;
    for (const auto& instance : b.simulation->instances())
      if (instance->setup().name.starts_with("cart")) uses.push_back(instance->setup().use);
    return uses;
  }
  static double range(const BuiltScenario& b, std::size_t ray) {
    const World& world = b.simulation->world();
    return world.values(world.object("cart/lidar"), keys::ranges)[ray];
  }
  std::string refusal(const std::string& more) {
    return test::complaint_of<SetupError>([&] { built(more); });
  }
  test::ScratchFolder scratch_;
};

using Lines = std::vector<std::string>;

/// Checks the device 4.5 m before a wall that is 9 m wide.
TEST_F(ModelSubsystems, MeasureWhereTheirModelPutsThem) {
  const BuiltScenario b = built("");
  EXPECT_EQ(uses(b), (Lines{"laser.embree", "motion.articulated", "sensor.error"}));
  b.simulation->run_for(0.06);
  EXPECT_NEAR(range(b, 2), 4.5, 1e-6);
  EXPECT_NEAR(range(b, 1), 4.5 / std::cos(0.5), 1e-6);
  EXPECT_EQ(range(b, 0), 50) << "beside the wall";
}

/// Checks an inertia of 0.1 kg m^2 on 3.6 N m/rad: it swings with 6 rad/s about the reference 0.5 rad.
TEST_F(ModelSubsystems, ASpringSwingsAboutItsReference) {
  const BuiltScenario b = built("");
  for (int quarter = 1; quarter <= 4; ++quarter) {
    b.simulation->run_for(std::numbers::pi / 12);
    const double swing = 0.5 - 0.5 * std::cos(quarter * std::numbers::pi / 2);
    EXPECT_NEAR(b.simulation->world().value("cart/hinge", keys::joint_position), swing, 0.02) << quarter;
  }
}

TEST_F(ModelSubsystems, AreChangedByTheScenarioKeyByKey) {
  const BuiltScenario faster = built("    lidar: {rate: 50, rays: 3}\n");
  faster.simulation->run_for(0.021);
  EXPECT_NEAR(range(faster, 1), 4.5, 1e-6) << "the second of three rays";
  EXPECT_EQ(uses(built("    lidar: {use: laser.raycast, rate: 5}\n")), (Lines{"laser.raycast", "motion.articulated"}))
      << "another sensor, without the model's error";
  EXPECT_EQ(uses(built("    lidar_error: off\n")), (Lines{"laser.embree", "motion.articulated"}));
}

TEST_F(ModelSubsystems, AreSwitchedOffWithTheirErrors) {
  EXPECT_EQ(uses(built("    lidar: off\n")), Lines{"motion.articulated"});
}

TEST_F(ModelSubsystems, LeaveLinksWithoutWeightBesideADriveOfTheScenario) {
  scratch_.file("light.urdf", std::string(model).replace(std::string(model).find("<gazebo reference=\"base\">"), 0,
                                                         "<gazebo reference=\"base\"><gravity>0</gravity></gazebo>\n"));
  const BuiltScenario b = build(
      read_scenario(scratch_.file("light.yaml",
                                  "robots: {cart: {model: light.urdf, at: {z: 1}, motion: {use: motion.articulated}, "
                                  "lift: {use: drive.gravity_compensation, links: [mast]}}}\n"),
                    {}),
      test::plugins());
  EXPECT_EQ(uses(b), (Lines{"laser.embree", "motion.articulated", "drive.gravity_compensation", "sensor.error",
                            "drive.gravity_compensation"}));
}

/// Checks that the default contact law is there although a drive adds to `wrench.external`, too.
TEST_F(ModelSubsystems, LinksWithoutWeightStandOnTheGroundLikeOthers) {
  const std::string scene =
      "world: {objects: {ground: {shape: plane}}}\nrobots: {box: {shape: {box: [0.2, 0.2, 0.2]}, mass: 2, at: {z: "
      "0.1}, "
      "motion: {use: motion.simplified}, lift: {use: drive.gravity_compensation, fraction: 0.5}}}\n";
  const BuiltScenario b = build(read_scenario(scratch_.file("box.yaml", scene), {}), test::plugins());
  b.simulation->run_for(1);
  EXPECT_NEAR(b.simulation->world().value("box/body", keys::pose).position.z(), 0.1, 1e-3);
}

TEST_F(ModelSubsystems, GiveWayToAnErrorOfTheScenario) {
  EXPECT_EQ(uses(built("    mine: {use: sensor.error, on: lidar, sigma: 0.1}\n")),
            (Lines{"laser.embree", "motion.articulated", "sensor.error"}));
}

TEST_F(ModelSubsystems, HoldTheBaseOfMotionsThatKnowIt) {
  const BuiltScenario held = built(""), free = built("", "motion.articulated, base: free");
  for (const BuiltScenario* b : {&held, &free}) b->simulation->run_for(0.1);
  const auto height = [](const BuiltScenario& b) {
    return b.simulation->world().value("cart/base", keys::pose).position.z();
  };
  EXPECT_EQ(height(held), 1);
  EXPECT_NEAR(height(free), 1 - 0.5 * 9.81 * 0.01, 1e-3) << "the scenario goes before";
  EXPECT_EQ(uses(built("", "motion.point")), (Lines{"laser.embree", "motion.point", "sensor.error"}))
      << "it has no base to hold";
}

TEST_F(ModelSubsystems, ThatAreNotThereCannotBeChanged) {
  EXPECT_NE(refusal("    lidr: off\n")
                .find("nothing is named `lidr` in robot `cart`, so it cannot be switched off; "
                      "there are: motion (did you mean `lidar`?); the model brings: lidar, "
                      "lidar_error, motion"),
            std::string::npos);
  EXPECT_NE(refusal("    camera: {rate: 3}\n").find("subsystem `camera` of robot `cart` needs `use: NAME`"),
            std::string::npos);
}

/// Checks a drive whose joints are not wheels, which Gazebo would run.
TEST_F(ModelSubsystems, ThatCannotBeConnectedAreLeftOutWithAWarning) {
  std::string with_drive = model;
  with_drive.insert(with_drive.find("</robot>"),
                    "<gazebo><plugin filename='libgazebo_ros_diff_drive.so'><leftJoint>hinge</leftJoint>"
                    "<rightJoint>hinge</rightJoint></plugin></gazebo>\n");
  scratch_.file("driven.urdf", with_drive);
  const std::string text =
      "robots: {cart: {model: driven.urdf, at: {z: 1}, motion: {use: motion.articulated, rate: 1000}";
  testing::internal::CaptureStderr();
  const BuiltScenario b = build(read_scenario(scratch_.file("driven.yaml", text + "}}\n"), {}), test::plugins());
  b.simulation->run_for(0.05);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(
      told.find("driven.urdf:17:9: cart.drive (drive.differential) cannot be connected: joint `hinge` cannot drive "
                "a wheel: "),
      std::string::npos)
      << told;
  EXPECT_NE(told.find("; it is left out\n"), std::string::npos) << told;
  const std::string named = scratch_.file("named.yaml", text + ", drive: {use: drive.differential}}}\n");
  EXPECT_THROW(build(read_scenario(named, {}), test::plugins()), SetupError) << "what the scenario names must work";
}

TEST_F(ModelSubsystems, AreThoseOfEachVariant) {
  EXPECT_EQ(
      uses(
          built("    count: 2\n    place: {list: [{y: 0, z: 1}, {y: 3, z: 1}]}\n    variants: {\"1\": {lidar: off}}\n"))
          .size(),
      3U);
}

}  // namespace
}  // namespace muro::host
