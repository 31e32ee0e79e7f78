// SPDX-License-Identifier: MIT
// The properties of control code's ports, and errors in connections.
#include "library_testing.hpp"

namespace muro::control {
namespace {

/// Robots with a scanner: an object `laser` with constant readings.
struct Seeing : Team {
  Seeing() {
    laser = add_sensor("laser", {1, 2, 3, 4});
    world().set(laser, keys::laser_columns, 4u);
  }
  ObjectId add_sensor(const std::string& name, const std::vector<double>& ranges) {
    const ObjectId sensor = add_sensor_object(*a, name, a->base());
    world().set_array(sensor, keys::ranges, std::span<const double>(ranges));
    world().set(sensor, keys::laser_min_angle, 0.5);
    return sensor;
  }
  void see(Settings settings = {}) {
    if (!settings.contains("inputs")) settings["inputs"] = Texts{"angle=laser.min_angle"};
    control_by(folder + "see.so", {{a, a->base()}}, std::move(settings));
  }
  ObjectId laser = no_object;
};

TEST(ControllerLibrary, ReadsTheOnlyObjectThatHasAPropertyAndConvertsIt) {
  Seeing s;
  s.see();
  s.build();
  s.run_for(0.1);
  const Twist& seen = s.command(*s.a);
  EXPECT_EQ(seen.linear, Vec3(1, 4, 4)) << "first range, last range, columns (a whole number)";
  EXPECT_EQ(seen.angular.x(), 0.5);
}

TEST(ControllerLibrary, PrefersTheReadingOfTheDeviceToTheTrueOne) {
  const Key<double> measured{"ranges.measured", "m", "as the device reports it"};
  const std::vector<double> readings{1.5, 2.5, 3.5};
  for (const auto& [connection, first] : {std::pair{"", 1.5}, {"ranges=ranges", 1.0}, {"ranges=laser:ranges", 1.0}}) {
    Seeing s;
    s.world().set_array(s.laser, measured, std::span<const double>(readings));
    Texts inputs{"angle=laser.min_angle"};
    if (*connection) inputs.push_back(connection);
    s.see({{"inputs", inputs}});
    s.build();
    s.run_for(0.1);
    EXPECT_EQ(s.command(*s.a).linear.x(), first) << connection;
  }
}

TEST(ControllerLibrary, AsksWhichObjectIsMeantWhenSeveralHaveAProperty) {
  Seeing s;
  s.add_sensor("rear", {7, 8});
  s.see();
  EXPECT_TRUE(says(
      refusal(s),
      "robot `a`: input `ranges` of `see` cannot be connected: several objects of robot `a` have a property `ranges`: "
      "`laser`, `rear`; choose in `inputs`, e.g. \"ranges=laser:ranges\""));
  Seeing chosen;
  chosen.add_sensor("rear", {7, 8});
  chosen.see({{"inputs", Texts{"ranges=rear:ranges", "angle=rear:laser.min_angle"}}});
  chosen.build();
  chosen.run_for(0.1);
  EXPECT_EQ(chosen.command(*chosen.a).linear.head<2>(), Eigen::Vector2d(7, 8));
}

TEST(ControllerLibrary, PrefersTheObjectItIsOn) {
  Seeing s;
  const ObjectId rear = s.add_sensor("rear", {7, 8});
  s.control_by(folder + "see.so", {{s.a, rear}}, {{"inputs", Texts{"angle=laser.min_angle"}}});
  s.build();
  s.run_for(0.1);
  EXPECT_EQ(s.command(*s.a).linear, Vec3(7, 8, 4)) << "the columns are those of the only object that has them";
}

TEST(ControllerLibrary, SetsSeveralPropertiesSideBySide) {
  Seeing s;
  const ObjectId left = s.world().object("a/left"), right = s.world().object("a/right");
  s.world().set(left, keys::joint_position, 0.25);
  s.world().set(right, keys::joint_position, -0.75);
  s.see({{"inputs", Texts{"angle=laser.min_angle", "ranges=left:joint.position,right:joint.position"}}});
  EXPECT_TRUE(
      says(refusal(s), "`a/left:joint.position` is in \"rad\", for the joint turns, but the library works in \"m\""));

  Team team;
  team.control_by(folder + "team.so", {},
                  {{"inputs", Texts{"poses=a/body:pose,b/body:pose"}},
                   {"outputs", Texts{"commands=a/body:command.twist,b/body:command.twist"}}});
  team.build();
  team.run_for(0.1);
  EXPECT_EQ(team.command(*team.a).linear.x(), 4);
  EXPECT_EQ(team.command(*team.b).linear.x(), -4);
  team.run_for(9.9);
  EXPECT_NEAR(team.pose(*team.a).position.x(), 2, 1e-6);
  EXPECT_NEAR(team.pose(*team.b).position.x(), 2, 1e-6);
}

TEST(ControllerLibrary, AJointPropertyOfManyJointsNeedsAChoice) {
  Seeing s;
  s.world().set(s.world().object("a/left"), keys::joint_position, 0.25);
  s.world().set(s.world().object("a/right"), keys::joint_position, -0.75);
  s.see({{"inputs", Texts{"angle=joint.position"}}});
  EXPECT_TRUE(
      says(refusal(s),
           "several objects of robot `a` have a property `joint.position`: `left`, `right`; choose in `inputs`, e.g. "
           "\"angle=left:joint.position\" (several, separated by commas, stand side by side)"));
}

TEST(ControllerLibrary, NamesWhatIsWrongWithAConnection) {
  const auto refused = [](const std::string& input) { return refusal_of("circle.so", {{"inputs", Texts{input}}}); };
  EXPECT_TRUE(says(refused("pos=twist"),
                   "`inputs`: `pos=twist`: library `circle` has no such input (did you mean `pose`?); it has: pose"));
  EXPECT_TRUE(says(refused("pose"), "`inputs`: `pose` must be \"port=object:property\" or \"port=property\""));
  EXPECT_TRUE(says(refused("pose="), "`inputs`: `pose=` names no property"));
  EXPECT_TRUE(says(refused("pose=body:"), "names no property"));
  EXPECT_TRUE(says(refused("pose=bdy:pose"), "robot `a` has no object `bdy` (did you mean `body`?); it has `body`, "));
  EXPECT_TRUE(
      says(refused("pose=body:psoe"), "object `a/body` has no property `psoe` (did you mean `pose`?); it has `"));
  EXPECT_TRUE(says(refused("pose=body:collision.shapes"), "has no property `collision.shapes`"));
  EXPECT_TRUE(says(refusal_of("circle.so", {{"inputs", Texts{"pose=body:pose", "pose=b/body:pose"}}}),
                   "connects port `pose` a second time"));
  EXPECT_TRUE(
      says(refusal_of("circle.so", {{"arguments", Texts{"fast"}}}), "`arguments`: `fast` must be \"name=value\""));
  Team team;
  const std::vector<Shape> shapes{Shape::sphere(1)};
  team.world().set_array(team.a->base(), keys::collision_shapes, std::span<const Shape>(shapes));
  team.control(folder + "circle.so", {{"inputs", Texts{"pose=collision.shapes"}}});
  EXPECT_TRUE(says(refusal(team), "`a/body:collision.shapes` is of type muro.Shape, which is not made of numbers"));
}

}  // namespace
}  // namespace muro::control
