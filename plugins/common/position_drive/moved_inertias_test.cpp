// SPDX-License-Identifier: MIT
#include "moved_inertias.hpp"

#include <gtest/gtest.h>

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
