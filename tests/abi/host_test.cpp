// SPDX-License-Identifier: MIT
// Behaviour of a host with plugins of another minor version, and with plugins that ask for extensions.
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "core/simulation.hpp"
#include "muro/vocabulary.hpp"

namespace muro {
namespace {

/// Returns the lines that one robot with the algorithm logs during a second at 100 Hz and at its end.
std::vector<std::string> log_of(const std::string& folder, const std::string& algorithm) {
  Registry registry({folder});
  Simulation s(registry);
  std::vector<std::string> lines;
  s.set_log([&](LogLevel, std::string_view text) { lines.emplace_back(text); });
  RobotTree tree;
  tree.base("base");
  tree.close();
  const RobotView& robot = s.world().add_robot("rover", tree, {});
  s.use(algorithm, 100, {{&robot, robot.base()}});
  s.build();
  s.run_for(1);
  s.finish();
  return lines;
}

TEST(PreviousMajor, IsRefusedByNameWithWhatToDo) {
  std::string said;
  try {
    log_of(ABI_PLUGIN_DIR "/sdk_4_0", "sensor.of_sdk_4_0");
  } catch (const SetupError& e) {
    said = e.what();
  }
  EXPECT_NE(
      said.find("sdk_4_0/of_sdk_4_0.so was built for another muro: sdk_major is 4 in the plugin and 5 in this muro"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("sdk/CHANGELOG.md"), std::string::npos) << said;
}

constexpr char sdk_5_0[] = ABI_PLUGIN_DIR "/sdk_5_0";

TEST(PreviousMinor, PluginWithShorterStructsSeesAllOfItsHost) {
  Registry registry({sdk_5_0});
  Simulation s(registry);
  std::vector<std::string> lines;
  s.set_log([&](LogLevel, std::string_view text) { lines.emplace_back(text); });
  std::vector<Item> items;
  for (const char* name : {"a", "b", "c"}) {
    RobotTree tree;
    tree.base("base");
    tree.translation({1, 0, 0});
    tree.body("arm");  // parents -1, 0, 1
    tree.translation({1, 0, 0});
    tree.body("hand");
    tree.close();
    const RobotView& robot = s.world().add_robot(name, tree, {});
    items.push_back({&robot, robot.base()});
  }
  s.use("sensor.of_sdk_5_0", 10, items, {{"second", 5.0}});
  s.build();
  s.run_for(1);
  s.finish();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].ends_with("parameters 8, parents 0, bases 3, served 90")) << lines[0] << ": 3 phases, 10 steps";
}

TEST(PreviousMinor, MembersThatAPluginDoesNotKnowHaveTheirDefaults) {
  Registry registry({sdk_5_0});
  const Description& d = *registry.algorithm("sensor.of_sdk_5_0").description;
  ASSERT_EQ(d.parameters.size(), 2u);
  EXPECT_EQ(d.parameters[1].name, "second");
  EXPECT_EQ(d.parameters[1].default_number, 4);
  EXPECT_EQ(d.parameters[1].length, 0u);
  EXPECT_TRUE(d.parameters[1].choices.empty());
  EXPECT_EQ(d.reads[1].key, "twist");
  EXPECT_TRUE(d.reads[1].when.empty());
  EXPECT_EQ(d.features, Features{0});
}

TEST(PreviousMinor, ShorterShapesOfAReaderAreCompleted) {
  Registry registry({sdk_5_0});
  Simulation s(registry);
  const std::string path = testing::TempDir() + "robot.of_sdk_5_0";
  std::ofstream(path) << "anything";
  const RobotView& robot = s.world().add_robot("robot", s.read_model(path), {});
  const std::span<const Shape> shapes = s.world().constants(robot.base(), keys::collision_shapes);
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].size, Vec3(1, 2, 3));
  EXPECT_EQ(shapes[1].kind, ShapeKind::sphere);
  EXPECT_EQ(shapes[1].size.x(), 4);
  EXPECT_EQ(shapes[1].origin.position, Vec3(5, 6, 7));
  EXPECT_EQ(shapes[1].surface.friction, Surface{}.friction);
  EXPECT_EQ(shapes[1].color, Shape{}.color);
}

class Extension : public testing::TestWithParam<std::pair<const char*, std::vector<const char*>>> {};

TEST_P(Extension, IsGrantedToWhoMeansTheSame) {
  const auto& [algorithm, expected] = GetParam();
  const auto lines = log_of(ABI_PLUGIN_DIR "/asks", algorithm);
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t i = 0; i < lines.size(); ++i) EXPECT_NE(lines[i].find(expected[i]), std::string::npos) << lines[i];
}
constexpr char another_layout[] = "the plugin has version 1 of extension muro.Inspection with another layout";
INSTANTIATE_TEST_SUITE_P(
    Of, Extension,
    testing::Values(
        std::pair("sensor.asks_the_same", std::vector{"granted"}),
        std::pair("sensor.asks_more_data", std::vector{another_layout, "refused"}),
        std::pair("sensor.asks_more_functions", std::vector{another_layout, "refused"}),
        std::pair("sensor.asks_version_2",
                  std::vector{"the plugin asks for version 2 of extension muro.Inspection, and this muro has version 1",
                              "refused"}),
        std::pair("sensor.asks_unheard_of", std::vector{"refused"})),
    [](const auto& test) { return std::string(test.param.first).substr(std::string("sensor.").size()); });

}  // namespace
}  // namespace muro
