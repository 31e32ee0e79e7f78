// SPDX-License-Identifier: MIT
// Impossible numbers, names and times are refused where they enter.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/simulated_time.hpp"
#include "core/text_table.hpp"
#include "core/world.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/limits.hpp"
#include "muro/base/printable.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr double no_numbers[] = {1e308, -1e308, nan, infinity, -infinity};

TEST(Limits, NoPoseShapeInertiaOrGravityOutOfRangeIsTaken) {
  for (const double x : no_numbers) {
    World world;
    const Shape box = Shape::box({1, 1, 1}), wrong = Shape::box({1, x, 1});
    const std::span<const Shape> shapes(&box, 1), wrong_shapes(&wrong, 1);
    EXPECT_SAYS(test::complaint_of([&] {
                  world.add_scenery("a", {{x, 0, 0}, Quat::Identity()}, shapes);
                }),
                "`pose` of `a` has a coordinate that is not from -1e8 to 1e8 m");
    EXPECT_SAYS(test::complaint_of([&] { world.add_scenery("b", {}, wrong_shapes); }),
                "`collision.shapes` of `b` has a size that is not from 1e-9 to 1e6 m");
    EXPECT_EQ(world.object_count(), 1u) << "nothing half-made is left";
    EXPECT_SAYS(test::complaint_of([&] { world.set(world_object, keys::gravity, Vec3(0, 0, x)); }),
                "`gravity` of `world` has a component that is not from -1e4 to 1e4 m/s^2");
    const ObjectId body = world.add_object("body");
    EXPECT_SAYS(test::complaint_of([&] { world.set(body, keys::inertial, {.mass = 1, .ixx = x}); }), "an inertia");
    EXPECT_SAYS(test::complaint_of([&] {
                  world.set(body, keys::initial_twist, {{0, x, 0}, Vec3::Zero()});
                }),
                "a velocity");
  }
}

TEST(Limits, AModelSaysWhichPartIsOutOfRange) {
  for (const double x : no_numbers) {
    RobotTree tree;
    tree.base("base");
    tree.translation({0, x, 0});
    tree.revolute("hinge", Vec3::UnitZ(), {.damping = x});
    tree.body("arm");
    tree.set(keys::inertial, {.mass = x});
    const Shape ball = Shape::sphere(x);
    tree.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
    tree.close();
    EXPECT_FALSE(tree.usable());
    ASSERT_GE(tree.problems().size(), 4u);
    EXPECT_EQ(tree.problems()[0].text, "a translation with a component that is not from -1e8 to 1e8 m");
    EXPECT_EQ(tree.problems()[1].text, "joint `hinge` has a damping or friction that is not from 0 to 1e12");
    EXPECT_EQ(tree.problems()[2].text, "`inertial` of `arm` has a mass that is not from 0 to 1e9 kg");
    EXPECT_EQ(tree.problems()[3].text, "`collision.shapes` of `arm` has a size that is not from 1e-9 to 1e6 m");
  }
}

TEST(Limits, LimitsOfJointsThatAreFarAwayAreNone) {
  RobotTree tree;
  tree.base("base");
  tree.revolute("hinge", Vec3::UnitZ(), {.lower = -1e16, .upper = 1e16, .velocity = 1e30});
  tree.close();
  ASSERT_TRUE(tree.usable());
  EXPECT_EQ(tree.links()[1].link.limits.lower, -infinity);
  EXPECT_EQ(tree.links()[1].link.limits.upper, infinity);
}

TEST(Limits, ARobotHasNoMassOrOneThatForcesCanMove) {
  RobotTree tree;
  tree.base("base");
  tree.set(keys::inertial, {.mass = 1e-300});
  tree.close();
  ASSERT_EQ(tree.problems().size(), 1u);
  EXPECT_EQ(tree.problems()[0].text, "all its bodies together have 1e-300 kg; 0, or 1e-9 to 1e9 kg are possible");
}

TEST(Limits, TimesAreNumbersOfNanosecondsThatExist) {
  EXPECT_EQ(nanoseconds_of(1.5, "it"), 1'500'000'000);
  EXPECT_EQ(nanoseconds_of(4.6e9, "it"), max_time);
  for (const double wrong : {-1e-300, 4.7e9, 1e300, nan, infinity, -infinity})
    EXPECT_SAYS(test::complaint_of([&] { nanoseconds_of(wrong, "the duration"); }), "s but must be from 0 to 4.6e9 s");
}

TEST(Names, OfObjectsAreThoseOfFiles) {
  World world;
  world.add_object(std::string(255, 'x'));
  EXPECT_SAYS(test::complaint_of([&] { world.add_object(std::string(256, 'x')); }), "has a name of 256 bytes");
  EXPECT_SAYS(test::complaint_of([&] { world.add_object("a\x1b[31m"); }), "is named `a\\x1b[31m`");
  EXPECT_SAYS(test::complaint_of([&] { world.add_object("a\xff"); }), "`a\\xff`");
  EXPECT_EQ(world.object_count(), 2u);
}

TEST(Messages, ShowControlCharactersAndBrokenUtf8AsBytes) {
  EXPECT_EQ(printable("plain \u00e4\u20ac\U0001F600"), "plain \u00e4\u20ac\U0001F600");
  EXPECT_EQ(printable("\x1b[2J\r\n\x7f"), "\\x1b[2J\\x0d\\x0a\\x7f");
  EXPECT_EQ(printable("\u009b31m \u202e"), "\\xc2\\x9b31m \\xe2\\x80\\xae") << "one character that is as good as ESC [";
  EXPECT_EQ(printable("\xc0\xaf \xed\xa0\x80 \xf5 \xe2\x82"), "\\xc0\\xaf \\xed\\xa0\\x80 \\xf5 \\xe2\\x82");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shortened("a\u20acb", 2), "a...") << "no part of a character";
  EXPECT_STREQ(SetupError("two\nlines, `\x07`").what(), "two\nlines, `\\x07`");
  const std::string long_word = "`" + std::string(100'000, 'x') + "` and `b`";
  EXPECT_EQ(std::string(SetupError(long_word).what()), "`" + std::string(512, 'x') + "...` and `b`");
}

TEST(Messages, TheNearestNameToALongWordIsNotLookedFor) {
  std::vector<std::string> names;
  for (int i = 0; i < 10'000; ++i) names.push_back("name_" + std::to_string(i));
  EXPECT_EQ(nearest_names(std::string(100'000, 'n'), names, 3), std::vector<std::string>{});
  EXPECT_EQ(nearest_names("nam_77", names, 1), std::vector<std::string>{"name_77"});
  names.emplace_back(100'000, 'n');
  EXPECT_EQ(nearest_names("nnn", names, 1), std::vector<std::string>{names.back()}) << "it contains it";
}

TEST(TextTable, FindsEachOfManyTexts) {
  TextTable table;
  EXPECT_EQ(table.intern(""), no_text);
  for (std::uint32_t i = 1; i <= 200'000; ++i) ASSERT_EQ(table.intern("text " + std::to_string(i)), TextId{i});
  const TextTable copy = table;
  table.intern("another");
  EXPECT_EQ(copy.size(), 200'001u);
  EXPECT_EQ(copy[TextId{77}], "text 77");
  EXPECT_EQ(table.intern("text 77"), TextId{77});
}

}  // namespace
}  // namespace muro
