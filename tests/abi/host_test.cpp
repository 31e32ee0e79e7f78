// SPDX-License-Identifier: MIT
// Behaviour of a host with plugins of another minor version, and with plugins that ask for extensions.
#include <gtest/gtest.h>

#include "core/simulation.hpp"

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

TEST(PreviousMinor, PluginOfSdk4_0RunsInThisHost) {
  const auto lines = log_of(ABI_PLUGIN_DIR "/sdk_4_0", "sensor.of_sdk_4_0");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].ends_with("1 items, 100 steps, the last at 990000000 ns, with Inspection")) << lines[0];
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
