// SPDX-License-Identifier: MIT
// Parts of the team's software, each alone against expected values: its messages, and the places that a camera sees.
#include <gtest/gtest.h>

#include "message.hpp"
#include "obstacles.hpp"
#include "sight.hpp"

namespace mixed_team {
namespace {

std::vector<double> bytes_of(const Message& m, std::int64_t least = 0) {
  std::vector<double> bytes(256);
  bytes.resize(write(m, least, bytes));
  return bytes;
}

TEST(Message, ComesAsItWasSentToACentimetre) {
  Message sent{{-12.34, 5.67}, 54321, 1, 17.9, {}};
  sent.targets.learn({{-4.01, 300.25}, 9, 0});
  sent.targets.learn({{5.5, -2.125}, 300, 1});
  const auto came = read(bytes_of(sent));
  ASSERT_TRUE(came);
  EXPECT_NEAR(came->at.x, -12.34, 0.005);
  EXPECT_NEAR(came->at.y, 5.67, 0.005);
  EXPECT_EQ(came->name, 54321);
  EXPECT_EQ(came->claim, 1u);
  EXPECT_EQ(came->cost, 17);
  ASSERT_EQ(came->targets.size(), 2u);
  EXPECT_NEAR(came->targets[0].at.y, 300.25, 0.005);
  EXPECT_EQ(came->targets[0].sightings, 9);
  EXPECT_EQ(came->targets[1].sightings, 255) << "of eight bits";
  EXPECT_EQ(came->targets[1].confirmed, 1);
}

TEST(Message, FitsIntoAFrameOf802154) {
  Message full{{}, 1, 0, 0, {}};
  for (int i = 0; i < 20; ++i) full.targets.learn({{double(i), 0}, 1, 0});
  EXPECT_EQ(full.targets.size(), Targets::most);
  EXPECT_LE(bytes_of(full).size(), 127u);
}

TEST(Message, LeavesOutWhatWasSeenTooSeldom) {
  Message sent{{}, 1, 1, 0, {}};
  sent.targets.learn({{1, 1}, 2, 0});
  sent.targets.learn({{3, 3}, 5, 0});
  const auto came = read(bytes_of(sent, 3));
  ASSERT_TRUE(came);
  ASSERT_EQ(came->targets.size(), 1u);
  EXPECT_EQ(came->targets[0].at.x, 3);
  EXPECT_EQ(came->claim, 0u) << "the number in the list that is sent";
}

TEST(Message, IsNotReadOutOfOtherBytes) {
  EXPECT_FALSE(read(std::vector<double>{}));
  EXPECT_FALSE(read(std::vector<double>(30, 1.0)));
  std::vector<double> cut = bytes_of([] {
    Message m;
    m.targets.learn({{1, 2}, 1, 0});
    return m;
  }());
  cut.pop_back();
  EXPECT_FALSE(read(cut)) << "shorter than it says";
}

TEST(Targets, OfTwoMatesBecomeOneByPlace) {
  Targets mine;
  mine.see({1, 1});
  mine.see({1.2, 1});
  EXPECT_EQ(mine.size(), 1u);
  EXPECT_NEAR(mine[0].at.x, 1.1, 1e-12) << "the mean";
  EXPECT_EQ(mine.learn({{1.3, 1.1}, 7, 1}), 0u);
  EXPECT_EQ(mine[0].at.x, 1.3) << "by more sightings";
  EXPECT_EQ(mine[0].confirmed, 1);
  EXPECT_EQ(mine.learn({{1.91, 1.1}, 1, 0}), 1u) << "more than 0.6 m away is another one";
}

TEST(Sight, SeesTheGroundBelowWhereItIs) {
  const Camera down{.fx = 100, .fy = 100, .cx = 80, .cy = 60, .x = 0.1, .z = -0.5, .pitch = std::acos(-1) / 2};
  const double level[] = {0, 0, 0, 1};
  // 2 m below the camera, a pixel is 2 cm; upwards in the picture is forwards
  const auto p = down.place(80 + 30, 60 - 20, 2.5, level);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, 0.1 + 0.4, 1e-12);
  EXPECT_NEAR(p->y, -0.6, 1e-12);
  // rolled to the left by atan(0.1): the right side is higher, and the camera looks to the right
  const double half = 0.5 * std::atan(0.1), rolled[] = {std::sin(half), 0, 0, std::cos(half)};
  const Camera centred{.fx = 100, .fy = 100, .cx = 80, .cy = 60, .x = 0, .z = 0, .pitch = std::acos(-1) / 2};
  EXPECT_NEAR(centred.place(80, 60, 2, rolled)->y, 0.2, 1e-12);
  const Camera ahead{.fx = 100, .fy = 100, .cx = 80, .cy = 60};
  EXPECT_FALSE(ahead.place(80, 50, 0.5, level)) << "the sky";
}

TEST(Sight, FindsBlobsOfItsColourAlone) {
  const int width = 8, height = 6;
  std::vector<double> rgb(std::size_t(3 * width * height), 100.0);
  const auto paint = [&](int u, int v, double r, double g, double b) {
    double* const p = &rgb[std::size_t(3 * (v * width + u))];
    p[0] = r, p[1] = g, p[2] = b;
  };
  for (const auto& [u, v] : {std::pair{2, 2}, {3, 2}, {3, 3}}) paint(u, v, 255, 117, 1);
  paint(6, 4, 60, 90, 250);  // blue
  paint(7, 1, 160, 70, 0);   // in the shadow, at the rim
  BlobFinder finder;
  const auto blobs = finder.find(rgb, width, height, {0.07, 0.035}, 1);
  ASSERT_EQ(blobs.size(), 2u);
  EXPECT_TRUE(blobs[0].is_cut);
  EXPECT_EQ(blobs[1].pixels, 3);
  EXPECT_NEAR(blobs[1].u, (2.5 + 3.5 + 3.5) / 3, 1e-12);
  EXPECT_NEAR(blobs[1].v, (2.5 + 2.5 + 3.5) / 3, 1e-12);
}

TEST(Obstacles, LeaveAWayOnTheSideThatIsFree) {
  Obstacles wall(0.3);
  for (double y = -0.2; y <= 1; y += 0.1) wall.add({1, y}, 0);
  EXPECT_NEAR(wall.free_way(0, 3), 0.7, 1e-9);
  const Obstacles::Way way = wall.best(0, 3, 0);
  EXPECT_LT(way.heading, 0) << "to the right, where the wall ends";
  EXPECT_GT(way.free, 2);
}

}  // namespace
}  // namespace mixed_team
