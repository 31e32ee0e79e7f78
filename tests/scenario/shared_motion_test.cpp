// SPDX-License-Identifier: MIT
// Robots of several groups with equal motions are items of one motion.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/scenario.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

BuiltScenario build_of(const std::string& text) {
  const test::ScratchFolder folder;
  return build(read_scenario(folder.file("s.yaml", text), {}), test::plugins());
}

/// Returns a scenario with two teams of three and two humanoids.
std::string teams(const std::string& motion_of_red, const std::string& schedule = "") {
  return R"(
world: {objects: {ground: {shape: plane}}}
robots:
  blue: &team
    model: )" MURO_TEST_SOURCE_DIR
         R"(/examples/models/humanoid.urdf
    count: 3
    place: {list: [{y: 0}, {y: 1}, {y: 2}]}
    motion: {use: motion.articulated, rate: 1000, joints: position}
  red:
    <<: *team
    count: 2
    place: {list: [{x: 1}, {x: 1, y: 1}]}
    motion: )" +
         motion_of_red + "\n" + schedule;
}

constexpr const char* alike = "{use: motion.articulated, rate: 1000, joints: position}";

/// Returns the number of items of each motion.
std::vector<std::size_t> items_of_motions(const BuiltScenario& b) {
  std::vector<std::size_t> items;
  for (const auto& i : b.simulation->instances())
    if (i->description().kind == Kind::motion) items.push_back(i->setup().items.size());
  return items;
}

using Items = std::vector<std::size_t>;

TEST(SharedMotion, ServesTheRobotsOfGroupsThatMoveAlike) {
  const BuiltScenario b = build_of(teams(alike));
  EXPECT_EQ(items_of_motions(b), Items{5});
  for (const auto& i : b.simulation->instances()) {
    if (i->description().kind != Kind::motion) continue;
    ASSERT_EQ(i->setup().item_setups.size(), 5u);
    EXPECT_EQ(i->setup().item_setups[2].name, "blue.motion");
    EXPECT_EQ(i->setup().item_setups[3].name, "red.motion") << "messages name the group that is concerned";
  }
}

TEST(SharedMotion, IsNotOfGroupsThatDiffer) {
  EXPECT_EQ(items_of_motions(build_of(teams("{use: motion.articulated, rate: 500, joints: position}"))), (Items{3, 2}));
  EXPECT_EQ(items_of_motions(build_of(teams("{use: motion.articulated, rate: 1000, joints: effort}"))), (Items{3, 2}));
}

TEST(SharedMotion, MovesARobotToTheSameBitsAsOneOfItsOwn) {
  const BuiltScenario shared = build_of(teams(alike));
  const BuiltScenario own = build_of(teams(alike, "schedule: {sequences: [[red.motion, blue.motion]]}"));
  ASSERT_EQ(items_of_motions(own), (Items{3, 2})) << "a sequence says which runs first";
  shared.simulation->run_for(0.1);
  own.simulation->run_for(0.1);
  EXPECT_EQ(shared.simulation->state_hash(), own.simulation->state_hash());
}

TEST(SharedMotion, IsNotOfLevelsOfOneRobotThatAreAlike) {
  const BuiltScenario switching = build_of(R"(
robots:
  ball: {shape: {sphere: 0.1}, mass: 1, motion: {levels: {one: {use: motion.point, rate: 20}, two: {use: motion.point, rate: 20}}}}
)");
  EXPECT_EQ(items_of_motions(switching), (Items{1, 1}));
}

}  // namespace
}  // namespace muro::host
