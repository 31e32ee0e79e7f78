// SPDX-License-Identifier: MIT
// Settings that a scenario may give, and the messages for wrong ones.
#include <gtest/gtest.h>

#include "joints_testing.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::joints {
namespace {

std::string refusal(const std::string& mode, Settings settings) {
  return test::complaint_of<SetupError>([&] {
    Arms s(mode, 1, std::move(settings));
    s.build();
    s.run_for(0.02);
  });
}
std::string refusal_of_groups(Texts groups, const std::string& mode = "position") {
  return refusal(mode, stream_at("tcp=0", {{"groups", std::move(groups)}}));
}

TEST(SetUpOfJoints, RefusesGroupsThatMakeNoSense) {
  EXPECT_SAYS(refusal_of_groups({"arm"}), "`groups`: `arm` must be \"name=member,member,...\"");
  EXPECT_SAYS(refusal_of_groups({"=elbow"}), "must begin with a name of letters, digits, `_`, `-` and `.`");
  EXPECT_SAYS(refusal_of_groups({"arm=elbow,,slide"}), "has an empty name behind `=` or `,`");
  EXPECT_SAYS(refusal_of_groups({"arm=elbow", "arm=slide"}), "two groups have the name `arm`");
  EXPECT_SAYS(refusal_of_groups({"arm=elbwo"}),
              "group `arm`: robot `arm_0` has no joint `elbwo` (did you mean `elbow`?); a group may have `shoulder`, "
              "`elbow`, `slide`, `command.twist`");
  EXPECT_SAYS(refusal_of_groups({"arm=elbow,e*"}), "group `arm`: `elbow` is in it twice");
  EXPECT_SAYS(refusal_of_groups({"base=command.twist"}),
              "`command.twist`: nothing of robot `arm_0` takes command.twist; use motion.point, or add a drive");
}

TEST(SetUpOfJoints, RefusesOtherParametersThatMakeNoSense) {
  EXPECT_SAYS(refusal("position", {}), "stream");
  EXPECT_SAYS(refusal("position", stream_at("tpc=1")), "unknown key `tpc` (did you mean `tcp`?)");
  EXPECT_SAYS(refusal("position", stream_at("tcp=0", {{"protocol", "jason"}})), "protocol");
  EXPECT_SAYS(refusal("position", stream_at("tcp=0", {{"name", "a/b"}})),
              "`name` is `a/b`, but must be made of letters");
  EXPECT_SAYS(refusal("position", stream_at("tcp=0", {{"on_disconnect", "go"}})), "on_disconnect");
  EXPECT_SAYS(test::complaint_of([] {
                Arms s("position", 1, stream_at("tcp=0", {{"report", 500.0}}));
                s.build();
              }),
              "`report` is 500 Hz, more than the rate of the controller, 100 Hz; raise `rate`, or lower `report`");
}

TEST(SetUpOfJoints, RefusesARobotWithNothingToControl) {
  const std::string complaint = test::complaint_of<SetupError>([] {
    wire::Served s;
    s.add("rock", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
    s.use("motion.simplified", 1000, s.all_robots());
    s.use("controller.joints", 50, s.all_robots(), stream_at("tcp=0"));
    s.build();
  });
  EXPECT_SAYS(complaint,
              "robot `rock` has nothing to control: its motion simulates no joints, and nothing takes "
              "command.twist");
}

TEST(SetUpOfJoints, AJointThatNoMotionSimulatesIsNamed) {
  const std::string complaint = test::complaint_of<SetupError>([] {
    wire::Served s;
    s.add("arm_0", arm_tree());
    s.use("motion.point", 1000, s.all_robots(), {{"joints", "passive"}});
    s.use("controller.joints", 50, s.all_robots(), stream_at("tcp=0", {{"groups", Texts{"arm=elbow"}}}));
    s.build();
  });
  EXPECT_SAYS(complaint, "joint `elbow` of robot `arm_0` is neither read nor set");
}

TEST(SetUpOfJoints, WheelsBehindADriveAreReadAndNotSet) {
  wire::Served s;
  s.add("rover", test::two_wheeler(0.05, 0.3));
  s.use("motion.differential_drive", 1000, s.all_robots());
  s.use("drive.differential", 0, s.all_robots());
  s.use("controller.joints", 100, s.all_robots(), stream_at("tcp=0"));
  s.build();
  Client client(s.port("rover/joints"));
  EXPECT_EQ(ask(s, client, "info"), "info joints 1 100 all base");
  EXPECT_EQ(ask(s, client, "info all"), "info all 2 left_joint rad none - 0 0 right_joint rad none - 0 0");
  EXPECT_EQ(ask(s, client, "set all 1 1"), "error 7 `left_joint` takes no setpoint");
  ask(s, client, "set base 0.5 0 0");
  const std::vector<double> early = numbers_of(ask(s, client, "wait 0.1 all"));
  const std::vector<double> late = numbers_of(ask(s, client, "wait 1 all"));
  EXPECT_NEAR(late[1] - early[1], 0.5 / 0.05 * (late[0] - early[0]), 1e-9) << "v t / r";
}

TEST(SetUpOfJoints, AServoTakesPositionsWhereTheMotionTakesEfforts) {
  Arms s("effort");
  s.use("motor.servo", 1000, s.all_robots(), {{"stiffness", 20.0}, {"damping", 1.0}});
  s.build();
  Client client(s.port("arm_0/joints"));
  EXPECT_EQ(ask(s, client, "info all").substr(0, 46), "info all 3 shoulder rad position rad -1.5 2 el");
  EXPECT_EQ(ask(s, client, "effort all 1 1 1"), "error 7 `shoulder` takes no effort");
  ask(s, client, "position all 0.5 0.5 0.1");
  s.run_for(3);
  EXPECT_NEAR(s.position("elbow"), 0.5, 0.01);
}

TEST(SetUpOfJoints, RefusesWhatIsBeyondTheLimitsOfAJointAndChangesNothing) {
  Arms s("position");
  s.build();
  Client client(s.port("arm_0/joints"));
  ask(s, client, "set all 0.25 0 0");
  EXPECT_EQ(ask(s, client, "set all 0.5 0 0.75"),
            "error 6 `slide`: 0.75 is no position that it takes; allowed is 0 to 0.5 m");
  EXPECT_EQ(ask(s, client, "set all 2.5 0 0"),
            "error 6 `shoulder`: 2.5 is no position that it takes; allowed is -1.5 to 2 rad");
  EXPECT_EQ(s.joint("shoulder", keys::joint_position_target), 0.25);
  EXPECT_EQ(ask(s, client, "velocity all 0 0 0"), "error 7 `shoulder` takes no velocity");
}

TEST(SetUpOfJoints, TwoControllersOnOneRobotSpeakTwoProtocols) {
  Arms s("velocity", 1, stream_at("tcp=0", {{"groups", Texts{"arm=shoulder,elbow"}}}));
  s.use("controller.joints", 100, s.all_robots(),
        stream_at("tcp=0", {{"protocol", "binary"}, {"name", "gripper"}, {"groups", Texts{"gripper=slide"}}}));
  s.build();
  EXPECT_NE(s.port("arm_0/joints"), s.port("arm_0/gripper"));
}

}  // namespace
}  // namespace muro::joints
