// SPDX-License-Identifier: MIT
// Compares motions with differences of poses: velocity and acceleration follow from the path alone.
#include "frame_motion.hpp"

#include <gtest/gtest.h>

namespace muro::link_motion {
namespace {

/// Returns the motion of a device: on a base on a curve that turns about a tilted axis, a joint turns about y, and a
/// joint behind it shifts the device along x. All are smooth in t (s).
FrameMotion at(double t) {
  const Vec3 axis = Vec3(1, 2, 2) / 3;
  FrameMotion base;
  base.pose = {{t, t * t, 0.5 * t * t * t}, rotation_about(axis, 0.7 * t + 0.3 * t * t)};
  base.twist = {{1, 2 * t, 1.5 * t * t}, axis * (0.7 + 0.6 * t)};
  base.acceleration = {{0, 2, 3 * t}, axis * 0.6};
  const FrameMotion turned =
      base.at({{0.1, 0.2, 0.3}, from_rpy(0.4, 0.5, 0.6)}).behind(JointKind::revolute, Vec3::UnitY(), t * t, 2 * t, 2);
  const FrameMotion shifted = turned.at({{0.3, 0, 0.1}, from_rpy(0, 0.2, 0)})
                                  .behind(JointKind::prismatic, Vec3::UnitX(), 0.2 * t * t * t, 0.6 * t * t, 1.2 * t);
  return shifted.at({{0.05, 0.06, 0.07}, from_rpy(0.1, 0.2, 0.3)});
}

TEST(FrameMotion, HasTheVelocityOfItsPath) {
  const double t = 0.8, h = 1e-5;
  const FrameMotion before = at(t - h), now = at(t), after = at(t + h);
  EXPECT_LT(((after.pose.position - before.pose.position) / (2 * h) - now.twist.linear).norm(), 1e-8);
  const Quat turn = after.pose.orientation * before.pose.orientation.conjugate();
  EXPECT_LT((rotation_vector_of(turn) / (2 * h) - now.twist.angular).norm(), 1e-8);
}

TEST(FrameMotion, HasTheAccelerationOfItsVelocity) {
  const double t = 0.8, h = 1e-5;
  const FrameMotion before = at(t - h), now = at(t), after = at(t + h);
  EXPECT_LT(((after.twist.linear - before.twist.linear) / (2 * h) - now.acceleration.linear).norm(), 1e-8);
  EXPECT_LT(((after.twist.angular - before.twist.angular) / (2 * h) - now.acceleration.angular).norm(), 1e-8);
}

}  // namespace
}  // namespace muro::link_motion
