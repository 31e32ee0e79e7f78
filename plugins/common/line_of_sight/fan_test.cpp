// SPDX-License-Identifier: MIT
#include "fan.hpp"

#include <gtest/gtest.h>

#include <random>

namespace muro::line_of_sight {
namespace {

TEST(Fan, NamesEveryBoxThatALineTouches) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> at(-10, 10), size(0, 3), away(-1e-12, 1e-12);
  const auto point = [&] { return Vec3(at(engine), at(engine), 0.3 * at(engine)); };
  int touched = 0, looked_at = 0;
  for (int k = 0; k < 40; ++k) {
    const Vec3 centre = k % 4 == 0 ? Vec3(1, -2, 0) : point();
    std::vector<Aabb> boxes;
    for (int i = 0; i < 200; ++i) {
      const Vec3 low = i % 5 == 0 ? Vec3(centre + Vec3(away(engine), at(engine), away(engine))) : point();
      boxes.push_back({low, low + Vec3(size(engine), size(engine), size(engine))});
    }
    Fan fan;
    fan.begin(centre, no_robot);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) ASSERT_TRUE(fan.add(boxes[i], i));
    fan.close();
    for (int i = 0; i < 100; ++i) {
      const Vec3 along[] = {Vec3(at(engine), 0, 0), Vec3(0, at(engine), 0), Vec3(0, 0, at(engine))};
      const Vec3 to = i < 12 ? Vec3(centre + along[i % 3]) : point();
      const Segment segment = Segment::between(centre, to);
      std::vector<bool> expected, found(boxes.size());
      for (const Aabb& box : boxes) expected.push_back(segment.touches(box));
      fan.any(to, segment, [&](std::uint32_t item) {
        found[item] = true;
        return false;
      });
      ASSERT_EQ(found, expected) << k << " " << i;
      touched += int(std::count(found.begin(), found.end(), true));
      ++looked_at;
    }
  }
  EXPECT_GT(touched, looked_at) << "some boxes are in the way";
}

TEST(Fan, SaysWhenItHoldsTooManyBoxes) {
  Fan fan;
  fan.begin({0, 0, 0}, no_robot);
  for (std::uint32_t i = 0; i < Fan::most_boxes; ++i) EXPECT_TRUE(fan.add({{1, 1, 1}, {2, 2, 2}}, i));
  EXPECT_FALSE(fan.add({{1, 1, 1}, {2, 2, 2}}, 0));
  EXPECT_FALSE(fan.is_usable());
}

}  // namespace
}  // namespace muro::line_of_sight
