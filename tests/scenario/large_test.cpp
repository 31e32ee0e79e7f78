// SPDX-License-Identifier: MIT
// Scenarios that are much larger than hand-written ones. Linear work takes seconds; quadratic work would take hours.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/scenario/builder.hpp"
#include "host/scenario/occupancy.hpp"
#include "host/scenario/yaml.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

BuiltScenario built(const std::string& text) {
  const test::ScratchFolder folder;
  return build(read_scenario(folder.file("s.yaml", text), {}), test::plugins());
}

/// Returns `count` lines with their numbers in the places of `#`.
std::string lines(int count, const std::string& line) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    for (const char c : line) all += c == '#' ? std::to_string(i) : std::string(1, c);
    all += '\n';
  }
  return all;
}

TEST(LargeScenario, FindsEachOf300000Keys) {
  Node map = parse_yaml("{}", {"x", 0, 0});
  for (int i = 0; i < 300'000; ++i) map.child("key" + std::to_string(i), {}).scalar = std::to_string(i);
  Node copy = map;
  for (int i = 0; i < 300'000; ++i) ASSERT_EQ(copy.find("key" + std::to_string(i))->scalar, std::to_string(i));
  copy.erase("key7");
  EXPECT_EQ(copy.find("key7"), nullptr);
  EXPECT_EQ(copy.find("key8")->scalar, "8");
  EXPECT_EQ(copy.child("key7", {}).kind, Node::Kind::null);
  merge(copy, map);
  EXPECT_EQ(copy.find("key7")->scalar, "7");
  EXPECT_EQ(map.position_of("key299999"), 299'999u);
}

TEST(LargeScenario, TellsTheFirstOfVeryManyMistakes) {
  const std::string text = test::complaint_of([] { built(lines(50'000, "key#: 1")); });
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 200);
  EXPECT_NE(text.find("the scenario has no key `key0`"), std::string::npos);
  EXPECT_EQ(text.substr(text.rfind('\n') + 1), "and 49800 more");
}

TEST(LargeScenario, HasTensOfThousandsOfObjectsAndRobots) {
  const BuiltScenario b =
      built("world:\n  objects:\n" + lines(30'000, "    rock#: {shape: {sphere: 1}, at: {x: #}}") + "robots:\n" +
            lines(1000, "  ball#: {shape: {sphere: 1}, mass: 1, motion: {use: motion.point}}"));
  EXPECT_EQ(b.simulation->world().object_count(), 1u + 30'000u + 1000u);
  EXPECT_EQ(b.simulation->world().robots().size(), 1000u);
}

TEST(LargeScenario, RobotsThatDoNotFitAreCountedSoon) {
  const std::string text = test::complaint_of([] {
    built(
        "world: {places: {yard: [{size: [100, 100]}]}}\n"
        "robots:\n  ball: {shape: {sphere: 0.5}, mass: 1, count: 20000, place: {random: yard, clearance: 0}}\n");
  });
  // random sequential adsorption covers 0.547 of an area: 3483 circles around squares of 1 m on 100 m x 100 m
  EXPECT_NE(text.find("of 20000 copies of `ball` fit into `yard` without overlap"), std::string::npos) << text;
  const int fit = std::stoi(text.substr(text.find("only ") + 5));
  EXPECT_GT(fit, 3200);
  EXPECT_LT(fit, 3600);
}

TEST(Occupancy, DecidesAsALookAtEverythingDoes) {
  Occupancy occupancy;
  std::vector<Footprint> discs;
  std::vector<Obstacle> boxes;
  std::mt19937_64 engine(3);
  const auto random = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10.0, random(-3, 1.3));
    discs.push_back({random(-100, 100), random(-100, 100), size});
    occupancy.add(discs.back());
    boxes.push_back({{{random(-100, 100), random(-100, 100), 0}, from_rpy(0, i % 20 == 0 ? 0.3 : 0, random(-3, 3))},
                     0.3 * size,
                     0.1 * random(0, 10)});
    occupancy.add(boxes.back());
  }
  int free = 0;
  for (int i = 0; i < 5000; ++i) {
    const Footprint f{random(-120, 120), random(-120, 120), std::pow(10.0, random(-3, 0.7))};
    const double clearance = i % 3 * 0.1;
    bool expected = true;
    for (const Footprint& d : discs)
      expected = expected && std::hypot(f.x - d.x, f.y - d.y) >= f.radius + d.radius + clearance;
    for (const Obstacle& b : boxes) {
      const Vec3 p = b.pose.inverse() * Vec3(f.x, f.y, 0);
      const double dx = std::max(0.0, std::abs(p.x()) - b.half_x), dy = std::max(0.0, std::abs(p.y()) - b.half_y);
      expected = expected && std::hypot(dx, dy) >= f.radius + clearance;
    }
    ASSERT_EQ(occupancy.is_free(f, clearance), expected) << i;
    free += expected;
  }
  EXPECT_GT(free, 500);
  EXPECT_LT(free, 4500);
}

}  // namespace
}  // namespace muro::host
