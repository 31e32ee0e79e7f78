// SPDX-License-Identifier: MIT
// Drives at the stops of their joints, and states beyond all bounds, in every motion by forces.
#include <gtest/gtest.h>

#include "tests/robots/trial.hpp"
#include "tests/support/bodies.hpp"

namespace muro::robots {
namespace {

class EveryDrive : public ::testing::TestWithParam<std::string> {};

/// A link of 0.3 kg m^2 about its hinge that starts at its lower stop, without gravity.
struct Door : test::Scene {
  explicit Door(const std::string& motion) {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    add("door", test::tree_of([](RobotBuilder& b) {
          b.base("frame");
          b.set(keys::inertial, Inertia{.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("hinge", Vec3::UnitZ(), {.lower = 0, .upper = 1, .effort = 10});
          b.body("leaf");
          b.set(keys::inertial, Inertia{.mass = 1, .ixx = 0.3, .iyy = 0.3, .izz = 0.3});
        }));
    use(motion, 1000, all_robots(), {{"base", std::string("fixed")}});
    use_contacts();
    build();
  }
  double& hinge(const Key<double>& key) { return world().value("door/hinge", key); }
};

TEST_P(EveryDrive, DrivesAJointOffItsStopWithTheSpeedItIsToldTo) {
  Door door(GetParam());
  door.run_for(0.1);
  EXPECT_NEAR(door.hinge(keys::joint_position), 0, 1e-6);
  door.hinge(keys::joint_velocity_target) = 0.01;
  for (int i = 0; i < 100; ++i) {
    door.run_for(0.001);
    ASSERT_LT(door.hinge(keys::joint_velocity), 0.0105) << "10 N m alone would give it 0.033 rad/s in a step";
  }
  EXPECT_NEAR(door.hinge(keys::joint_velocity), 0.01, 1e-4);
  EXPECT_NEAR(door.hinge(keys::joint_position), 0.001, 1e-4);
}

TEST_P(EveryDrive, StopsAJointThatIsDrivenAgainstItsStop) {
  Door door(GetParam());
  door.hinge(keys::joint_velocity_target) = 2;
  door.run_for(2);
  EXPECT_NEAR(door.hinge(keys::joint_position), 1, 2e-3);
  EXPECT_NEAR(door.hinge(keys::joint_velocity), 0, 1e-3);
}

/// Motions by engines; motion.simplified accepts any finite number.
class EveryEngine : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryEngine, TellsWhenAStateHasLeftAllBounds) {
  test::Scene s;
  const RobotView& r = s.add("stone", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  s.use(GetParam(), 1000, s.all_robots());
  s.use_contacts();
  PropertyStore& store = s.world().store();
  auto& push = *static_cast<Wrench*>(store.bind(store.add_accessor("the test"), r.base(), keys::external_wrench,
                                                usage::accumulate, Multiplicity::single, 1, nullptr));
  s.build();
  push.force = {1e300, 0, 0};
  try {
    s.run_for(0.1);
    ADD_FAILURE() << "x = " << s.pose(r).position.x() << " m is a place";
  } catch (const StepError& e) {
    EXPECT_NE(
        std::string(e.what()).find("`stone`: the motion of its base is no longer finite. Likely cause: an external "
                                   "force of"),
        std::string::npos)
        << e.what();
  }
}

std::vector<std::string> engines() {
  std::vector<std::string> some = motions();
  std::erase_if(some, [](const std::string& id) { return (features_of(id) & feature_link_dynamics) == 0; });
  return some;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryEngine);
INSTANTIATE_TEST_SUITE_P(Bounds, EveryEngine, ::testing::ValuesIn(engines()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });
INSTANTIATE_TEST_SUITE_P(Stops, EveryDrive, ::testing::ValuesIn(motions()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

}  // namespace
}  // namespace muro::robots
