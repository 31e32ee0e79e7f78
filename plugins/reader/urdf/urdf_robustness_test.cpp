// SPDX-License-Identifier: MIT
// Large, deep and damaged files.
#include <gtest/gtest.h>
#include <pthread.h>

#include <random>

#include "core/robot_tree.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "recording_builder.hpp"

namespace muro::urdf {
namespace {

/// Returns a chain of `count` links; the order of the names is not the order of the chain.
std::string chain(int count) {
  std::string urdf = "<robot name='chain'>\n";
  const auto name = [](int i) { return concat("link", i); };
  for (int i = 0; i < count; ++i)
    urdf += concat("<link name='", name(i),
                   "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' ",
                   "izz='1'/></inertial></link>\n");
  for (int i = count - 1; i > 0; --i)
    urdf += concat("<joint name='joint", i, "' type='continuous'><parent link='", name(i - 1), "'/><child link='",
                   name(i), "'/><origin xyz='0 0 1'/></joint>\n");
  return urdf + "</robot>\n";
}

/// Runs `work` on a stack of 256 KiB, on which recursion over the links would overflow.
template <class Work>
void with_small_stack(Work work) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 256 << 10), 0);
  pthread_t thread;
  const auto run = [](void* w) -> void* {
    (*static_cast<Work*>(w))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &work), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

TEST(UrdfRobustness, AChainOfTenThousandLinksIsReadInOrder) {
  constexpr int count = 10000;
  RecordingBuilder robot;
  const std::string urdf = chain(count);
  with_small_stack([&] { read_text(urdf, "/nowhere", robot); });
  EXPECT_TRUE(robot.problems.empty());
  ASSERT_EQ(robot.calls.size(), 1u + 3u * (count - 1));
  EXPECT_EQ(robot.calls.front(), "base link0");
  EXPECT_EQ(robot.calls[3 * 5000 - 2], "translation 0 0 1");
  EXPECT_EQ(robot.calls[3 * 5000], "body link5000");
  EXPECT_EQ(robot.calls.back(), "body link9999");
}

TEST(UrdfRobustness, ALinkWithTenThousandChildrenIsReadInOrder) {
  constexpr int count = 10000;
  std::string urdf = "<robot name='star'><link name='hub'/>";
  for (int i = 0; i < count; ++i)
    urdf += concat("<link name='l", i, "'/><joint name='j", i, "' type='fixed'><parent link='hub'/><child link='l", i,
                   "'/></joint>");
  const RecordingBuilder robot = recorded(urdf + "</robot>");
  EXPECT_EQ(std::count(robot.calls.begin(), robot.calls.end(), "fork"), count - 1);
  EXPECT_EQ(std::count(robot.calls.begin(), robot.calls.end(), "end"), 2 * (count - 1));
  EXPECT_EQ(robot.calls[1], "fork");
  EXPECT_EQ(robot.calls[2], "body l0");
}

TEST(UrdfRobustness, DeeplyNestedElementsAreAnErrorNotAnOverflow) {
  std::string urdf = "<robot name='r'>";
  for (int i = 0; i < 200000; ++i) urdf += "<a>";
  for (int i = 0; i < 200000; ++i) urdf += "</a>";
  const RecordingBuilder robot = recorded(urdf + "</robot>");
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_EQ(robot.problems[0], "error 1:0 the file is not well-formed XML: elements are nested more than 100 deep");
}

/// Applies one random damage: a bit, a byte, a cut part, a doubled part, a swapped pair of words.
void damage(std::string& text, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
  const std::size_t at = below(text.size());
  /// Returns begin and length of a tag, from its `<` to its `>`.
  const auto tag_from = [&](std::size_t from) {
    const std::size_t open = text.find('<', from);
    if (open == text.npos) return std::pair(std::size_t(0), std::size_t(0));
    const std::size_t close = text.find('>', open);
    return std::pair(open, close == text.npos ? text.size() - open : close + 1 - open);
  };
  switch (below(8)) {
    case 0:
      text[at] = char(text[at] ^ (1 << below(8)));
      break;
    case 1:
      text[at] = char(random());
      break;
    case 2:
      text.erase(at, below(40));
      break;
    case 3:
      text.insert(at, text.substr(below(text.size()), below(200)));
      break;
    case 4: {
      const auto [begin, length] = tag_from(at);
      text.insert(begin, text.substr(begin, length));
      break;
    }
    case 5: {
      const auto [begin, length] = tag_from(at);
      text.erase(begin, length);
      break;
    }
    case 6: {  // another value for an attribute
      constexpr std::string_view values[] = {"",     "-1",        "0",         "1e308",    "nan",
                                             "%n%s", "base_link", "prismatic", "floating", "planar"};
      const std::size_t open = text.find('"', at);
      const std::size_t close = open == text.npos ? open : text.find('"', open + 1);
      if (close != text.npos) text.replace(open + 1, close - open - 1, values[below(std::size(values))]);
      break;
    }
    default: {
      const std::size_t line = text.find('\n', at);
      if (line != text.npos) text.resize(random() % 20 == 0 ? line : text.size());
    }
  }
}

TEST(UrdfRobustness, DamagedRoversAreReportedOrBuiltSoundly) {
  const std::string folder = MURO_TEST_SOURCE_DIR "/examples/models";
  const std::string rover = model_file::load_file(folder + "/rover.urdf", ".urdf");
  std::mt19937 random(20240521);
  int refused = 0, warned = 0, clean = 0;
  testing::internal::CaptureStderr();
  for (int variant = 0; variant < 2000; ++variant) {
    std::string text = rover;
    for (std::size_t damages = 1 + random() % 4; damages > 0; --damages) damage(text, random);
    RobotTree tree;
    read_text(text, folder, tree);
    if (!tree.usable()) {
      ++refused;
      continue;
    }
    (tree.problems().empty() ? clean : warned)++;
    // the host can use everything that the reader accepts
    tree.close();
    ASSERT_TRUE(tree.usable()) << "variant " << variant << ": " << tree.problems().back().text << "\n" << text;
    for (const auto& flat : tree.links()) {
      ASSERT_TRUE(flat.link.origin.position.allFinite()) << "variant " << variant;
      ASSERT_NEAR(flat.link.origin.orientation.norm(), 1, 1e-9) << "variant " << variant;
      ASSERT_FALSE(flat.link.limits.lower > flat.link.limits.upper) << "variant " << variant;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  // the damage is neither harmless nor always fatal
  EXPECT_GT(refused, 200);
  EXPECT_GT(warned, 50);
  EXPECT_GT(clean, 50);
}

}  // namespace
}  // namespace muro::urdf
