// SPDX-License-Identifier: MIT
// Messages about sensors at places where they cannot be.
#include <gtest/gtest.h>

#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {
namespace {

/// Returns the message of a set-up with one sensor on a vehicle of motion.point, or "" if it is accepted.
std::string message_of(const std::string& id, const std::string& on, Trial::Parameters parameters = {},
                       const std::string& motion = "motion.point") {
  Trial t(motion);
  t.add_vehicle();
  t.add_sensor(id, on, std::move(parameters));
  try {
    t.start();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

void expect_in(const std::string& text, const std::string& message) {
  EXPECT_NE(message.find(text), std::string::npos) << message;
}

TEST(SensorMessages, AnEncoderNeedsAJoint) {
  expect_in("is mounted on `disc`; name a joint with `on`; those of the robot are: `table`",
            message_of("sensor.encoder", "disc"));
  expect_in("`joints` names `tabel`, but the robot has no such joint",
            message_of("sensor.encoder", "disc", {{"joints", std::vector<std::string>{"tabel"}}}));
}

TEST(SensorMessages, AnImuNeedsALink) {
  expect_in("`table`, which is a joint; name a link, such as `disc`", message_of("sensor.imu", "table"));
}

TEST(SensorMessages, NothingCarriesABase) {
  expect_in("mounted on the base of `r`, which nothing carries", message_of("sensor.force_torque", "base_link"));
}

TEST(SensorMessages, AFootOfARobotWithoutForcesFeelsNothing) {
  expect_in("no force moves `r`", message_of("sensor.foot", "base_link"));
}

TEST(SensorMessages, ABumperThatNobodyTellsOfContactsIsRefused) {
  expect_in("give its motion `on_contact: stop`", message_of("sensor.bumper", "base_link"));
}

TEST(SensorMessages, ATruthOfNobodyIsRefused) {
  expect_in("nothing in the scene is named `moon`", message_of("sensor.truth", "base_link", {{"of", "moon"}}));
}

TEST(SensorMessages, APlaceBeyondThePolesIsRefused) {
  expect_in("give a latitude from -90 to 90 deg",
            message_of("sensor.gps", "base_link", {{"reference", std::vector<double>{91, 0, 0}}}));
}

TEST(SensorMessages, AThresholdBelowTheReleaseIsRefused) {
  expect_in("release_threshold (7", message_of("sensor.foot", "base_link",
                                               {{"threshold", 5.0}, {"release_threshold", 7.0}}, "motion.simplified"));
}

TEST(SensorMessages, AJointThatNothingMovesStandsStill) {
  EXPECT_EQ(message_of("sensor.accelerometer", "disc", {}, "motion.point"), "");
}

/// Control code that moves a joint itself gives no acceleration of it.
TEST(SensorMessages, AJointThatControlCodeMovesHasNoAcceleration) {
  Trial t("motion.point");
  t.add_vehicle();
  t.add_sensor("sensor.accelerometer", "disc");
  PropertyStore& store = t.world().store();
  store.bind(store.add_accessor("control code"), t.world().object("r/table"), keys::joint_position, usage::write,
             Multiplicity::single, 1, nullptr);
  try {
    t.start({{"joints", "passive"}});
    FAIL() << "it was connected";
  } catch (const SetupError& error) {
    expect_in("no motion moves the joint `r/table`", error.what());
  }
}

}  // namespace
}  // namespace muro::sensor_conformance
