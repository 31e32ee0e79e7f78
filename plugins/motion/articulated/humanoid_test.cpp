// SPDX-License-Identifier: MIT
// A humanoid with light feet: it stands on level ground and on slopes, on soft and on hard contacts, and falls when its
// servos are off.
#include "articulated_testing.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro::articulated::testing {
namespace {

struct Humanoid : World {
  const RobotView* robot;
  double mass;

  Humanoid(double slope, double stiffness, const std::string& joints = "position", double knees = 0, int count = 1) {
    const Quat along = from_rpy(0, -slope, 0);
    add_ground(0.8, {Vec3::Zero(), along});
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf");
    for (int i = 0; i < count; ++i) {
      robot = &add("r" + std::to_string(i), model, {along * Vec3(0, 2.0 * i, model.standing_height()), along});
      const std::string name(robot->name);
      const std::pair<const char*, double> bends[] = {{"hip_pitch", 1}, {"knee", 2}, {"ank_pitch", 1}};
      for (const std::string side : {"l_", "r_"})
        for (const auto& [joint, part] : bends) {
          const ObjectId object = world().object(name + "/" + side + joint);
          world().set(object, keys::initial_joint_position, part * (side == "l_" ? knees : -knees));
        }
    }
    mass = mass_of(*this, *robot);
    start({{"joints", joints}, {"frequency", std::sqrt(stiffness / mass) / (2 * M_PI)}});
  }
};

TEST(AHumanoid, StandsOnSoftAndOnHardGround) {
  for (const double stiffness : {1e4, 1e5, 1e6}) {
    Humanoid s(0, stiffness);
    s.run_for(3);
    const double weight = s.mass * g;
    EXPECT_NEAR(s.contact_force(*s.robot).z(), weight, 1e-6 * weight) << stiffness << " N/m";
    const Pose before = s.pose(*s.robot);
    s.run_for(1);
    const Pose after = s.pose(*s.robot);
    EXPECT_LT((after.position - before.position).norm(), 1e-6) << stiffness << " N/m";
    EXPECT_LT(after.orientation.angularDistance(before.orientation), 1e-6) << stiffness << " N/m";
  }
}

TEST(AHumanoid, StandsOnASlopeWithoutCreeping) {
  for (const double stiffness : {1e4, 1e6}) {
    Humanoid s(5 * M_PI / 180, stiffness);
    s.run_for(4);
    const Vec3 before = s.pose(*s.robot).position;
    s.run_for(1);
    EXPECT_LT((s.pose(*s.robot).position - before).norm(), 1e-6) << stiffness << " N/m";
    const double weight = s.mass * g;
    EXPECT_LT((s.contact_force(*s.robot) - Vec3(0, 0, weight)).norm(), 1e-5 * weight) << stiffness << " N/m";
  }
}

TEST(AHumanoid, FallsWhenItsServosAreOff) {
  Humanoid s(0, 1e5, "passive");
  s.twist(*s.robot).linear.x() = 0.3;
  const double before = s.pose(*s.robot).position.z();
  s.run_for(4);
  EXPECT_LT(s.pose(*s.robot).position.z(), 0.5 * before);
  EXPECT_GT(s.pose(*s.robot).position.z(), 0) << "it lies on the ground";
  EXPECT_LT(s.twist(*s.robot).linear.norm(), 0.1) << "and is quiet";
  EXPECT_NEAR(s.contact_force(*s.robot).z(), s.mass * g, 0.1 * s.mass * g);
}

TEST(AHumanoid, StepsWithoutAllocationOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(test::allocations(), 0u) << "sanitizers count allocations themselves";
#else
  Humanoid s(0, 1e5, "position", 0, 5);
  s.run_for(1);
  const std::uint64_t before = test::allocations();
  s.run_for(0.5);
  EXPECT_EQ(test::allocations() - before, 0u);
#endif
}

}  // namespace
}  // namespace muro::articulated::testing
