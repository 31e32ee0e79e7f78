// SPDX-License-Identifier: MIT
#include "property_scalars.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "muro/vocabulary.hpp"

namespace muro::view {
namespace {

template <class T>
LiveProperty live(const Key<T>& key, T& first, Multiplicity multiplicity = Multiplicity::single,
                  std::uint32_t count = 1) {
  LiveProperty p;
  p.key = &key;
  p.multiplicity = multiplicity;
  p.count = count;
  p.data = &first;
  return p;
}

TEST(ValuesInTheWindow, AreReadAndEditedByTheirParts) {
  Pose pose{{1, 2, 3}, Quat::Identity()};
  const LiveProperty p = live(keys::pose, pose);
  const Scalars values(p);
  ASSERT_EQ(values.size(), 7u);
  EXPECT_EQ(values.label(2), "z");
  EXPECT_EQ(values.get(2), 3);
  values.set(2, 4.5);
  EXPECT_EQ(pose.position.z(), 4.5);
}

TEST(ValuesInTheWindow, TakeNothingThatIsOutOfRange) {
  Pose pose{{1, 2, 3}, Quat::Identity()};
  const LiveProperty p = live(keys::pose, pose);
  const Scalars values(p);
  for (const double wrong : {1e9, -1e308, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(values.set(0, wrong));
    EXPECT_EQ(pose.position, Vec3(1, 2, 3)) << wrong;
  }
  EXPECT_TRUE(values.set(3, 1));  // qx beside qw = 1
  EXPECT_NEAR(pose.orientation.x(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(pose.orientation.norm(), 1, 1e-15);
  EXPECT_FALSE(Scalars(live(keys::joint_velocity, pose.position.x())).set(0, std::nan("")));
}

TEST(ValuesInTheWindow, HaveNumbersInArrays) {
  std::uint8_t bytes[] = {1, 2, 3};
  const LiveProperty p = live(keys::camera_image, bytes[0], Multiplicity::array, 3);
  const Scalars values(p);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values.label(1), "[1]");
  values.set(1, 1000);
  EXPECT_EQ(bytes[1], 255) << "as much as it holds";
  values.set(1, -3);
  EXPECT_EQ(bytes[1], 0);
}

TEST(ValuesInTheWindow, HaveNoNumbersWhenTheyAreOpaque) {
  Shape shape;
  EXPECT_EQ(Scalars(live(keys::collision_shapes, shape, Multiplicity::array, 1)).size(), 0u);
}

}  // namespace
}  // namespace muro::view
