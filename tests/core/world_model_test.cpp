// SPDX-License-Identifier: MIT
// Content of a world as a reader reports it, before any of it is in a simulation.
#include "core/world_model.hpp"

#include <gtest/gtest.h>

#include "core/world.hpp"
#include "muro/vocabulary.hpp"

namespace muro {
namespace {

std::vector<std::string> errors(const WorldModel& world) {
  std::vector<std::string> texts;
  for (const auto& p : world.problems())
    if (p.severity == Severity::error) texts.push_back(p.text);
  return texts;
}

TEST(WorldModel, KeepsWhatItIsTold) {
  WorldModel world;
  WorldBuilder& builder = world;
  const Shape ball = Shape::sphere(1), box = Shape::box({1, 1, 1});
  builder.gravity({0, 0, -1.6});
  builder.friction_rule(std::uint32_t(FrictionRule::product));
  builder.scenery("rock", {{1, 2, 3}, Quat::Identity()}, {&ball, 1}, {&box, 1});
  builder.model("cart", {{4, 5, 6}, Quat::Identity()}).base("body");
  builder.model("car", {}).base("chassis");
  world.close();
  EXPECT_EQ(errors(world), std::vector<std::string>{});
  EXPECT_EQ(world.gravity(), Vec3(0, 0, -1.6));
  EXPECT_EQ(world.friction_rule(), FrictionRule::product);
  ASSERT_EQ(world.scenery().size(), 1u);
  EXPECT_EQ(world.scenery()[0].collisions.at(0).kind, ShapeKind::sphere);
  EXPECT_EQ(world.scenery()[0].visuals.at(0).kind, ShapeKind::box);
  ASSERT_EQ(world.models().size(), 2u);
  EXPECT_EQ(world.models()[0].pose.position, Vec3(4, 5, 6));
  EXPECT_TRUE(world.models()[1].tree.usable());
}

TEST(WorldModel, TellsWhatCannotBe) {
  WorldModel world;
  WorldBuilder& builder = world;
  builder.gravity(Vec3::Constant(NAN));
  builder.friction_rule(4);
  builder.scenery("rock", {}, {}, {});
  builder.scenery("", {}, {}, {});
  builder.model("rock", {}).base("body");
  builder.model("far", {Vec3::Constant(INFINITY), Quat::Identity()});
  world.close();
  EXPECT_EQ(errors(world), (std::vector<std::string>{"a gravity with a component that is not from -1e4 to 1e4 m/s^2",
                                                     "a friction rule that is none of 0 (min), 1 (mean), 2 (product), "
                                                     "3 (max)",
                                                     "scenery has no name",
                                                     "two things of the world are named `rock`; names are unique",
                                                     "a model `far` has a coordinate that is not from -1e8 to 1e8 m"}));
  EXPECT_FALSE(world.gravity().has_value());
  EXPECT_FALSE(world.friction_rule().has_value());
  // the tree of a model reports itself that it was never built
  EXPECT_FALSE(world.models()[1].tree.usable());
}

TEST(WorldModel, SceneryMayLookOtherThanWhatItCollidesWith) {
  World world;
  const Shape ball = Shape::sphere(1), box = Shape::box({1, 1, 1});
  const ObjectId rock = world.add_scenery("rock", {}, {&ball, 1}, {&box, 1});
  const ObjectId cloud = world.add_scenery("cloud", {}, {}, {&box, 1});
  const auto kind = [&](ObjectId object, const KeyInfo& key) {
    const ArrayHeader found = world.store().constant(object, key);
    return found.data ? int(static_cast<const Shape*>(found.data)->kind) : -1;
  };
  EXPECT_EQ(kind(rock, keys::collision_shapes), int(ShapeKind::sphere));
  EXPECT_EQ(kind(rock, keys::visual_shapes), int(ShapeKind::box));
  EXPECT_EQ(kind(cloud, keys::collision_shapes), -1);
}

}  // namespace
}  // namespace muro
