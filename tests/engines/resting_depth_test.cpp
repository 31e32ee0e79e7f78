// SPDX-License-Identifier: MIT
// Motions whose contacts are springs report robots that stand too deep in the bodies that carry them.
#include "tests/engines/engine_scene.hpp"

namespace muro::engines {
namespace {

class RestingDepth : public ::testing::TestWithParam<std::string> {
 protected:
  World w;

  /// Starts all robots so far with contacts of `frequency` (Hz): they rest g / (2 pi frequency)^2 deep, 1 cm at 5 Hz.
  void start(double frequency, Parameters parameters = {}) {
    parameters.emplace("frequency", frequency);
    w.start(GetParam(), std::move(parameters), 1000, {{"frequency", frequency}});
  }
  int times_told() const {
    int count = 0;
    for (std::size_t at = 0; (at = w.log.find(" mm deep in ", at)) != std::string::npos; ++at) ++count;
    return count;
  }
  void add_boxes() {
    w.add_ground();
    for (const double x : {0.0, 1.0})
      w.add(x > 0 ? "b" : "a", test::block(1, {0.2, 0.2, 0.2}, 0.5), {{x, 0, 0.1}, Quat::Identity()});
  }
};

TEST_P(RestingDepth, IsToldOnceOfAllRobotsThatStandTooDeep) {
  add_boxes();
  start(5);
  w.run_for(0.4);
  EXPECT_EQ(times_told(), 0) << "an impact is no rest";
  w.run_for(2);
  EXPECT_EQ(times_told(), 1) << w.log;
  EXPECT_SAYS(w.log, "` stands ");
  EXPECT_SAYS(w.log, " mm deep in `ground`: contacts are too soft for what they bear at this rate; try a higher rate");
}

TEST_P(RestingDepth, IsNotToldWhereContactsAreAsHardAsTheyShouldBe) {
  add_boxes();
  w.add("falls", test::ball(1, 0.1, 0.5), {{3, 0, 2}, Quat::Identity()});
  start(50);
  w.run_for(3);
  EXPECT_EQ(times_told(), 0) << w.log;
}

TEST_P(RestingDepth, IsNotToldWithTheWatchOff) {
  add_boxes();
  start(5, {{"watch", std::string("off")}});
  w.run_for(3);
  EXPECT_EQ(times_told(), 0) << w.log;
}

TEST_P(RestingDepth, IsNotToldOfABaseThatIsBuiltIntoTheGround) {
  w.add_ground();
  const Shape foot = test::with(Shape::box({0.2, 0.2, 0.2}), 0.5), bar = test::with(Shape::box({0.4, 0.1, 0.1}), 0.5);
  w.add("arm", test::tree_of([&](RobotBuilder& b) {
          b.base("foot");
          b.set(keys::inertial, test::solid_box(5, {0.2, 0.2, 0.2}));
          b.set_array(keys::collision_shapes, std::span<const Shape>(&foot, 1));
          b.translation({0, 0, 1});
          b.revolute("hinge", Vec3::UnitZ(), {});
          b.body("bar");
          b.set(keys::inertial, test::solid_box(1, {0.4, 0.1, 0.1}));
          b.set_array(keys::collision_shapes, std::span<const Shape>(&bar, 1));
        }),
        {{0, 0, 0.05}, Quat::Identity()});
  start(50, {{"base", std::string("fixed")}, {"joints", std::string("effort")}});
  w.run_for(2);
  EXPECT_EQ(times_told(), 0) << w.log;
}

INSTANTIATE_TEST_SUITE_P(Springs, RestingDepth,
                         ::testing::Values(std::string("motion.articulated"), std::string("motion.simplified")),
                         name_of);

}  // namespace
}  // namespace muro::engines
