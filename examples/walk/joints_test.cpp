// SPDX-License-Identifier: MIT
#include "joints.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace muro::walk_test {
namespace {

using namespace walking;

TEST(Joints, TurnAndStartAsTheRobotHasThem) {
  const Joints joints(18, "-+-", "0.1,0,-0.2");
  Posture p;
  p.legs[left_side] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  p.arm = {0.7, 0.8, 0.9};
  std::vector<double> q(18);
  joints.write(p, q);
  EXPECT_DOUBLE_EQ(q[0], -0.1 + 0.1);
  EXPECT_DOUBLE_EQ(q[1], 0.2);
  EXPECT_DOUBLE_EQ(q[2], -0.3 - 0.2);
  EXPECT_DOUBLE_EQ(q[13], 0.8);
  EXPECT_DOUBLE_EQ(q[15], 0.7);
  EXPECT_DOUBLE_EQ(q[16], -0.8) << "the right arm is mirrored";
  for (std::size_t j = 0; j < leg_joints; ++j) EXPECT_NEAR(joints.legs(q)[left_side][j], p.legs[left_side][j], 1e-15);
}

std::string complaint(std::size_t count, const char* directions, const char* zeros) {
  try {
    Joints(count, directions, zeros);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(Joints, SayWhatIsWrongWithThem) {
  EXPECT_EQ(complaint(11, "", ""),
            "joint.position.target has 11 joints; it needs those of both legs, 12, and takes 32 at most");
  EXPECT_EQ(complaint(12, "++x", ""), "directions=++x is not one + or - for each of 12 joints");
  EXPECT_EQ(complaint(12, "", "0.1,,2"),
            "zeros=0.1,,2 is no list of numbers with commas, one for each of 12 joints at most");
  EXPECT_EQ(complaint(12, "-", "0.1,2"), "");
}

}  // namespace
}  // namespace muro::walk_test
