// SPDX-License-Identifier: MIT
// Messages to a user who has named wrong feet or has no plane, and values of sensors that need forces.
#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/hills.hpp"
#include "walker_testing.hpp"

namespace muro::biped::testing {
namespace {

std::string feet_complaint(const Names& feet) {
  return test::complaint_of([&] { Walk w(100, {{"feet", feet}}); });
}

TEST(WrongFeet, AreNamedWithWhatTheRobotHas) {
  EXPECT_SAYS(feet_complaint({"left_foot", "right_fot"}),
              "feet: `r` has no link `right_fot` (did you mean `right_foot`?); links that carry no other: `left_foot`, "
              "`right_foot`");
  EXPECT_SAYS(feet_complaint({"left_ankle", "right_foot"}),
              "feet: `left_ankle` is a joint of `r`, and a foot is a link; the link behind it is `left_foot`");
  EXPECT_SAYS(feet_complaint({"left_foot", "left_foot"}), "feet: `left_foot` is named twice");
  EXPECT_SAYS(feet_complaint({"left_foot"}),
              "feet names the links of the two feet of `r`, as [left_foot, right_foot]; 1");
  EXPECT_SAYS(feet_complaint({"left_thigh", "left_foot"}),
              "feet: `left_thigh` lies between the base of `r` and `left_foot`, which is behind it");
  EXPECT_SAYS(feet_complaint({"left_foot", "left_shank"}), "feet: `left_shank` lies between");
  EXPECT_SAYS(feet_complaint({"trunk", "left_foot"}), "feet: `trunk` lies between");
  EXPECT_SAYS(feet_complaint({"left_foot", "right_thigh"}), "the foot `right_thigh` has no collision shape");
}

TEST(WrongFeet, WithoutAShapeHaveNoSole) {
  EXPECT_SAYS(test::complaint_of([] { Walk w(100, {}, {}, {}, {}); }), "the foot `left_foot` has no collision shape");
}

struct Floor : test::Scene {
  void add_walker(const Parameters& more = {}) {
    add("r", walker({flat_sole()}), {{0, 0, 1}, Quat::Identity()});
    Parameters parameters{{"feet", Names{"left_foot", "right_foot"}}};
    for (const auto& [name, value] : more) parameters[name] = value;
    use("motion.biped", 100, all_robots(), parameters);
    build();
  }
  void add_plane(const std::string& name, double height, const Quat& turn = Quat::Identity()) {
    const Shape plane = Shape::plane();
    world().add_scenery(name, {{0, 0, height}, turn}, std::span<const Shape>(&plane, 1));
  }
};

TEST(AFloor, ThatIsNoPlaneIsRefused) {
  Floor none;
  EXPECT_SAYS(test::complaint_of([&] { none.add_walker(); }), "the scenery has no plane on which a biped could put");
  Floor hilly;
  const test::Hills hills(8, 8, [](double x, double) { return 0.1 * x; });
  hills.add_to(hilly);
  EXPECT_SAYS(test::complaint_of([&] { hilly.add_walker(); }),
              "a biped puts its feet on a plane, and the scenery has a heightmap");
}

TEST(AFloor, OfSeveralPlanesIsNamed) {
  Floor two;
  two.add_plane("lower", 0);
  two.add_plane("upper", 0.5);
  EXPECT_SAYS(test::complaint_of([&] { two.add_walker(); }),
              "2 planes that look up; name with `plane` the one to walk on: `lower`, `upper`");
  Floor wrong;
  wrong.add_plane("lower", 0);
  EXPECT_SAYS(
      test::complaint_of([&] {
        wrong.add_walker({{"plane", std::string("r")}});
      }),
      "plane: there is no object `r` of the scenery with a plane among its collision shapes; there are: `lower`");
  Floor hall;
  hall.add_plane("wall", -3, from_rpy(0, M_PI / 2, 0));
  hall.add_plane("floor", 0.25);
  hall.add_walker();
  EXPECT_NEAR(hall.world().value("r/trunk", keys::pose).position.z(), 0.25 + leg_length, 1e-12) << "walls are no floor";
  Floor named;
  named.add_plane("lower", 0);
  named.add_plane("upper", 0.5);
  named.add_walker({{"plane", std::string("upper")}});
  EXPECT_NEAR(named.world().value("r/trunk", keys::pose).position.z(), 0.5 + leg_length, 1e-12);
}

std::string sensor_complaint(const std::string& sensor, const std::string& on) {
  return test::complaint_of([&] {
    test::Scene s;
    s.add_ground();
    const RobotView& r = s.add("r", walker({flat_sole()}), {{0, 0, 1}, Quat::Identity()});
    s.use("motion.biped", 100, s.all_robots(), {{"feet", Names{"left_foot", "right_foot"}}});
    const ObjectId object = s.add_sensor_object(r, "sensor", s.world().object(on));
    s.use(sensor, 100, {{&r, object}});
    s.use_kinematics();
    s.build();
  });
}

TEST(ForcesOnALeg, AreNotProvidedAndSensorsSaySo) {
  EXPECT_SAYS(sensor_complaint("sensor.foot", "r/left_foot"), "no force moves `r`");
  EXPECT_SAYS(sensor_complaint("sensor.foot", "r/left_foot"),
              "its motion itself tells `foot.contact` of `r/left_foot`");
  EXPECT_SAYS(sensor_complaint("sensor.force_torque", "r/left_ankle"),
              "no force moves `r`, so what the ground does to its foot `r/left_foot` is not known");
  EXPECT_SAYS(sensor_complaint("sensor.force_torque", "r/right_hip"), "`r/right_foot` is not known");
}

TEST(AHand, ThatIsBelowThePlaneIsToldOnce) {
  test::Scene s;
  s.add_ground();
  const Shape hand = Shape::sphere(0.05);
  std::vector<std::string> warnings;
  s.set_log([&](LogLevel level, std::string_view line) {
    if (level == LogLevel::warning) warnings.emplace_back(line);
  });
  for (const double x : {0.0, 1.0})
    s.add(x > 0 ? "b" : "a", walker({flat_sole()}, &hand), {{x, 0, 1}, Quat::Identity()});
  s.use("motion.biped", 100, s.all_robots(), {{"feet", Names{"left_foot", "right_foot"}}});
  s.build();
  const auto lift = [&](double left, double right) {
    for (const std::string robot : {"a/", "b/"}) {
      s.world().value(robot + "left_lift", keys::joint_position_target) = left;
      s.world().value(robot + "right_lift", keys::joint_position_target) = right;
    }
    s.run_for(0.05);
  };
  lift(0, 0.02);
  lift(0.02, 0);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  lift(0.27, 0.26);
  lift(0.26, 0.27);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_SAYS(warnings.front(), "/trunk` is 0.0");
  EXPECT_SAYS(warnings.front(), "m below the plane on which the robot walks; motion.biped keeps feet above it");
}

}  // namespace
}  // namespace muro::biped::testing
