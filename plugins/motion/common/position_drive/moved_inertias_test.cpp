// SPDX-License-Identifier: MIT
#include "moved_inertias.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro {
namespace {

MovedInertias::Body body_at(std::int32_t parent, JointKind joint, const Vec3& origin, const Vec3& axis, double mass,
                            const Vec3& com, double moment) {
  MovedInertias::Body body;
  body.link.parent = parent;
  body.link.joint = joint;
  body.link.origin.position = origin;
  body.link.axis = axis;
  body.inertia = {.mass = mass, .com = com, .ixx = moment, .iyy = moment, .izz = moment};
  return body;
}

/// Two rods of 0.4 m in a plane, on a base of 10 kg.
std::vector<MovedInertias::Body> two_links() {
  return {body_at(-1, JointKind::fixed, Vec3::Zero(), Vec3::UnitX(), 10, Vec3::Zero(), 2),
          body_at(0, JointKind::revolute, {0, 0, 1}, Vec3::UnitY(), 2, {0.2, 0, 0}, 0.03),
          body_at(1, JointKind::revolute, {0.4, 0, 0}, Vec3::UnitY(), 1, {0.2, 0, 0}, 0.02)};
}

TEST(JointFrames, PlaceBodiesAsPosesDo) {
  Link link;
  link.origin = {{0.1, -0.2, 0.3}, rotation_of(Vec3(0.4, 1.1, -0.7))};
  link.axis = Vec3(0.6, 0, 0.8);
  const Pose parent{{1, 2, 3}, rotation_of(Vec3(-0.2, 0.5, 2))};
  const BodyFrame on{columns_of(parent.orientation.toRotationMatrix()), plain(parent.position)};
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic, JointKind::fixed})
    for (const double position : {0.0, 1e-9, 0.7, 3.0, 100.0}) {
      link.joint = kind;
      const Pose pose = parent * pose_in_parent(link, position);
      lane::V3<double> axis;
      const BodyFrame frame = JointFrame(link).place(on, position, axis);
      const Vec3 point(0.3, -0.4, 0.5), there = pose * point, along = pose.orientation * link.axis;
      const lane::V3<double> at = frame.at(plain(point));
      EXPECT_LT((vector_of(at) - there).norm(), 1e-14 * (1 + position)) << position;
      EXPECT_LT((vector_of(axis) - along).norm(), 1e-15) << position;
    }
}

TEST(MovedInertias, AreTheDiagonalOfATwoLinkArmsInertiaMatrix) {
  // Spong, Hutchinson, Vidyasagar, Robot Modeling and Control, 7.4: d11, d22.
  MovedInertias inertias(two_links(), true);
  for (const double elbow : {0.0, 0.7, M_PI / 2, 3.0}) {
    inertias.update(std::vector<double>{0, 0.3, elbow});
    EXPECT_NEAR(inertias.driven(1), 2 * 0.04 + 0.03 + 0.02 + 1 * (0.16 + 0.04 + 2 * 0.4 * 0.2 * std::cos(elbow)),
                1e-12);
    EXPECT_NEAR(inertias.driven(2), 0.02 + 0.04, 1e-12);
    EXPECT_EQ(inertias.driven(2), inertias.free(2));
  }
}

TEST(MovedInertias, OfAFreeBaseAreThoseOfTheHeavierSide) {
  std::vector<MovedInertias::Body> bodies{
      body_at(-1, JointKind::fixed, Vec3::Zero(), Vec3::UnitX(), 3, Vec3::Zero(), 2),
      body_at(0, JointKind::prismatic, Vec3::Zero(), Vec3::UnitX(), 1, Vec3::Zero(), 1)};
  bodies[1].link.limits.armature = 0.5;
  MovedInertias slide(bodies, false);
  slide.update(std::vector<double>{0, 0.1});
  EXPECT_NEAR(slide.driven(1), 3 + 0.5, 1e-12);
  EXPECT_NEAR(slide.free(1), 0.75 + 0.5, 1e-12) << "the reduced mass";
  MovedInertias arm(two_links(), false);
  arm.update(std::vector<double>{0, 0, 0});
  EXPECT_NEAR(arm.driven(1), 10 * 1 + 2, 1e-12) << "the base about the shoulder";
}

}  // namespace
}  // namespace muro
