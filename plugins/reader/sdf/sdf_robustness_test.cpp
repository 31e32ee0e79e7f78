// SPDX-License-Identifier: MIT
// Large, deep and damaged files; several readers at once.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "plugins/common/model_file/text_file.hpp"
#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

const std::string source = MURO_TEST_SOURCE_DIR, models = source + "/examples/models";

/// Applies one random damage: a bit, a byte, a cut or doubled part, a lost or doubled tag, another value, a cut end.
void damage(std::string& text, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::size_t at = below(text.size());
  const auto between = [&](char first, char last) {
    const std::size_t open = text.find(first, at);
    if (open == text.npos) return std::pair(std::size_t(0), std::size_t(0));
    const std::size_t close = text.find(last, open + 1);
    return std::pair(open, close == text.npos ? text.size() - open : close + 1 - open);
  };
  switch (below(9)) {
    case 0:
      text[at] = char(text[at] ^ (1 << below(8)));
      break;
    case 1:
      text.erase(at, below(40));
      break;
    case 2:
      text.insert(at, text.substr(below(text.size()), below(200)));
      break;
    case 3: {
      const auto [begin, length] = between('<', '>');
      text.insert(begin, text.substr(begin, length));
      break;
    }
    case 4: {
      const auto [begin, length] = between('<', '>');
      text.erase(begin, length);
      break;
    }
    case 5: {  // another value for an attribute
      constexpr std::string_view values[] = {"",         "world", "base_link", "__model__", "a::b",
                                             "revolute", "ball",  "gearbox",   "1.4",       "%n%s"};
      const auto [begin, length] = between('"', '"');
      if (length > 1) text.replace(begin + 1, length - 2, values[below(std::size(values))]);
      break;
    }
    case 6: {  // another text between tags
      constexpr std::string_view values[] = {"",      "-1",    "0",          "1e308",       "nan",
                                             "0 0 0", "world", "laser_link", "1 2 3 4 5 6", "true"};
      const auto [begin, length] = between('>', '<');
      if (length > 1) text.replace(begin + 1, length - 2, values[below(std::size(values))]);
      break;
    }
    case 7: {  // a whole element twice
      const std::size_t open = text.find("<link", at), close = text.find("</link>", open);
      if (close != text.npos) text.insert(open, text.substr(open, close + 7 - open));
      break;
    }
    default: {
      const std::size_t line = text.find('\n', at);
      if (line != text.npos && random() % 10 == 0) text.resize(line);
    }
  }
}

void check_sound(const RobotTree& tree, const std::string& context) {
  for (const auto& flat : tree.links()) {
    ASSERT_TRUE(flat.link.origin.position.allFinite()) << context;
    ASSERT_NEAR(flat.link.origin.orientation.norm(), 1, 1e-9) << context;
    ASSERT_FALSE(flat.link.limits.lower > flat.link.limits.upper) << context;
  }
}

struct Outcomes {
  int refused = 0, warned = 0, clean = 0;
};

Outcomes read_damaged_rovers(unsigned seed, int variants) {
  const std::string rover = model_file::load_file(models + "/rover.sdf", ".sdf");
  std::mt19937 random(seed);
  Outcomes outcomes;
  testing::internal::CaptureStderr();
  for (int variant = 0; variant < variants; ++variant) {
    std::string text = rover;
    for (std::size_t damages = 1 + random() % 2; damages > 0; --damages) damage(text, random);
    RobotTree tree;
    read_text(text, models, tree);
    if (!tree.usable()) {
      ++outcomes.refused;
      continue;
    }
    (tree.problems().empty() ? outcomes.clean : outcomes.warned)++;
    tree.close();
    // the host can use everything that the reader accepts
    EXPECT_TRUE(tree.usable()) << "variant " << variant << ": " << tree.problems().back().text << "\n" << text;
    check_sound(tree, text);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return outcomes;
}

void check_damaged_rovers(int variants) {
  const Outcomes outcomes = read_damaged_rovers(20240521, variants);
  // the damage is neither harmless nor always fatal
  EXPECT_GT(outcomes.refused, variants / 10);
  EXPECT_GE(outcomes.warned, variants / 250);
  EXPECT_GT(outcomes.clean, variants / 50);
}

TEST(SdfRobustness, DamagedRoversAreReportedOrBuiltSoundly) { check_damaged_rovers(50); }
TEST(SlowSdfRobustness, ManyDamagedRoversAreReportedOrBuiltSoundly) { check_damaged_rovers(3000); }

void check_damaged_worlds(int variants) {
  const std::string yard = model_file::load_file(source + "/examples/yard/yard.sdf", ".sdf");
  std::mt19937 random(7);
  int refused = 0, read = 0;
  testing::internal::CaptureStderr();
  for (int variant = 0; variant < variants; ++variant) {
    std::string text = yard;
    for (std::size_t damages = 1 + random() % 3; damages > 0; --damages) damage(text, random);
    WorldModel world;
    read_world_text(text, source + "/examples/yard", world);
    world.close();
    const bool broken = std::any_of(world.problems().begin(), world.problems().end(),
                                    [](auto& p) { return p.severity == Severity::error; });
    ++(broken ? refused : read);
    if (broken) continue;
    for (const auto& s : world.scenery()) ASSERT_TRUE(s.pose.position.allFinite()) << text;
    for (const auto& m : world.models()) check_sound(m.tree, text);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, variants / 15);
  EXPECT_GT(read, variants / 15);
}

TEST(SdfRobustness, DamagedWorldsAreReportedOrBuiltSoundly) { check_damaged_worlds(20); }
TEST(SlowSdfRobustness, ManyDamagedWorldsAreReportedOrBuiltSoundly) { check_damaged_worlds(1000); }

TEST(SdfRobustness, AChainOfManyLinksIsReadInOrder) {
  constexpr int count = 200;
  std::string inside;
  for (int i = 0; i < count; ++i) inside += link(concat("l", i), concat("<pose>0 0 ", i, " 0 0 0</pose>"));
  for (int i = count - 1; i > 0; --i)
    inside += joint(concat("j", i), "continuous", concat("l", i - 1), concat("l", i), axis("0 1 0"));
  const Robot robot = robot_of(model(inside));
  EXPECT_EQ(robot.problems, Lines{});
  ASSERT_EQ(robot.tree.links().size(), std::size_t(count));
  EXPECT_TRUE(near(robot.pose("l199"), {{0, 0, 199}, Quat::Identity()}));
}

TEST(SdfRobustness, DeeplyNestedElementsAreAnErrorNotAnOverflow) {
  std::string text = "<sdf version='1.9'>";
  for (int i = 0; i < 200000; ++i) text += "<model name='m'>";
  const Robot robot = robot_of(text);
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_EQ(robot.problems[0], "error 1:0 the file is not well-formed XML: elements are nested more than 100 deep");
}

TEST(SdfRobustness, ThreadsThatReadAtOnceReadTheSame) {
  const std::string rover = model_file::load_file(models + "/rover.sdf", ".sdf");
  const std::string broken =
      model(link("a", "<pose relative_to='f'/>") + "<frame name='f'><pose relative_to='a'/></frame>");
  std::vector<Robot> rovers(8), others(8);
  std::vector<std::thread> threads;
  testing::internal::CaptureStderr();
  for (std::size_t i = 0; i < rovers.size(); ++i)
    threads.emplace_back([&, i] {
      rovers[i] = robot_of(rover, models);
      others[i] = robot_of(broken);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  for (std::size_t i = 0; i < rovers.size(); ++i) {
    EXPECT_EQ(rovers[i].blocks(), rovers[0].blocks());
    EXPECT_EQ(rovers[i].problems, Lines{});
    EXPECT_EQ(others[i].problems, others[0].problems);
  }
}

TEST(SdfRobustness, NothingIsLookedForBesideTheGivenPaths) {
  // a file of this name in the working folder is not used
  const test::ScratchFolder folder, elsewhere;
  elsewhere.file("wheel.sdf", "<sdf version='1.9'><model name='w'>" + link("l") + "</model></sdf>");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(elsewhere.path(""));
  const Robot robot = robot_of(model(link("a") + "<include><uri>wheel.sdf</uri></include>"), folder.path(""));
  std::filesystem::current_path(before);
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_NE(robot.problems[0].find("there is no such file or folder; looked for " + folder.path("wheel.sdf") + ";"),
            std::string::npos)
      << robot.problems[0];
}

}  // namespace
}  // namespace muro::sdf
