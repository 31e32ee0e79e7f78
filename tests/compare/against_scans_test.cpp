// SPDX-License-Identifier: MIT
// `muro compare --against`: compares a simulated laser scanner with recorded scans.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "muro/base/random.hpp"
#include "tests/compare/scip_text.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

constexpr double ray_step = 2 * M_PI / 1024;
constexpr int ray_count = 201;

/// Returns a scenario with a scanner and a wall 2 m in front of it; `error`: the parameters of its sensor.error.
std::string scenario(const std::string& error) {
  return "duration: 1\nworld:\n  objects:\n    wall: {shape: {box: [0.2, 8, 1]}, at: {x: 2.1, z: 0.5}}\n"
         "robots:\n  stand:\n    shape: {box: [0.1, 0.1, 0.1]}\n    mass: 1\n    at: {z: 0.5}\n"
         "    motion: {use: motion.point, rate: 100}\n"
         "    laser: {use: laser.raycast, rate: 10, rays: 201, min_angle: -0.61359231515, max_angle: 0.61359231515, "
         "max_range: 5.6}\n" +
         (error.empty() ? "" : "    error: {use: sensor.error, on: laser, rate: 10, " + error + "}\n");
}

double wall(int beam) { return 2 / std::cos((beam - 100) * ray_step); }

/// Returns a table of scans of the wall, `bias` (m) farther, with normal noise of `sigma` (m).
std::string table_of(int scans, double bias, double sigma) {
  std::string text =
      fmt::format("# scanner: UTM-30LX\n# angle_min: {:.9f}\n# angle_increment: {:.9f}\n", -100 * ray_step, ray_step) +
      "# range_min: 0.02\n# range_max: 5.6\ntime";
  for (int i = 0; i < ray_count; ++i) text += fmt::format(",ranges[{}]", i);
  for (int s = 0; s < scans; ++s) {
    text += fmt::format("\n{:.1f}", 0.1 * s);
    for (int i = 0; i < ray_count; ++i)
      text += fmt::format(",{:.6f}", wall(i) + bias + sigma * Random(5, std::uint64_t(i), 0).normal(std::uint32_t(s)));
  }
  return text + "\n";
}

class AgainstScans : public testing::Test {
 protected:
  test::CommandResult compare(const std::string& arguments) const {
    return test::run_command("cd " + folder.path("") +
                             " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " compare " + arguments);
  }
  /// Returns the median in t.csv, or NaN if there is no such row.
  double figure(const std::string& source, const std::string& quantity, const std::string& from = "") const {
    std::istringstream in(test::text_of(folder.path("t.csv")));
    for (std::string line; std::getline(in, line);) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (cells.size() > 7 && cells[1] == '"' + source + '"' && cells[2] == quantity && cells[3] == from)
        return std::stod(cells[7]);
    }
    return NAN;
  }
  const test::ScratchFolder folder;
};

TEST_F(AgainstScans, NoiseAndBiasAreThoseThatWerePutIn) {
  folder.file("s.yaml", scenario("sigma: 0.008"));
  folder.file("r.csv", table_of(150, 0.012, 0.004));
  const auto r = compare("s.yaml --against r.csv --known-map --csv t.csv --out t.svg");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NEAR(figure("recorded", "noise_over_time", "1.5"), 0.004, 0.0001);
  EXPECT_NEAR(figure("simulated", "noise_over_time", "1.5"), 0.008, 0.0002);
  EXPECT_NEAR(figure("recorded", "bias", "1.5"), 0.012, 0.0003);
  EXPECT_NEAR(figure("simulated", "bias", "1.5"), 0, 0.0003);
  EXPECT_NE(r.output.find("x2.0"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("at most 10"), std::string::npos) << "the data sheet of a UTM-30LX\n" << r.output;
  EXPECT_NE(r.output.find("+-30"), std::string::npos) << r.output;
  EXPECT_NE(test::text_of(folder.path("t.svg")).find("Noise of a laser scanner over range: r.csv"), std::string::npos);
}

TEST_F(AgainstScans, NoMapIsNeeded) {
  folder.file("s.yaml", scenario("sigma: 0.008"));
  folder.file("r.csv", table_of(150, 0, 0.004));
  const auto r = compare("s.yaml --against r.csv --csv t.csv");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NEAR(figure("recorded", "noise_over_time", "1.5"), 0.004, 0.0001);
  EXPECT_TRUE(std::isnan(figure("recorded", "bias", "1.5")));
}

TEST_F(AgainstScans, EveryLevelHasItsColumn) {
  folder.file("s.yaml", scenario("sigma: 0.004"));
  folder.file("r.csv", table_of(150, 0, 0.004));
  const auto r = compare("s.yaml --against r.csv --csv t.csv --vary stand.error=error,off");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NEAR(figure("error", "noise_over_time", "1.5"), 0.004, 0.0001);
  EXPECT_LT(figure("off", "noise_over_time", "1.5"), 1e-12);
  EXPECT_NE(r.output.find("has no sensor.error, so its ranges are the true ones"), std::string::npos) << r.output;
}

TEST_F(AgainstScans, ErrorCodesAreToldByTheirShare) {
  folder.file("s.yaml", scenario("sigma: 0.002, resolution: 0.001, dropout: 0.05"));
  std::string text;
  for (int s = 0; s < 100; ++s) {
    std::vector<std::uint32_t> values;
    for (int i = 0; i < ray_count; ++i) {
      const bool is_lost = Random(9, std::uint64_t(i), 2).uniform(std::uint32_t(s)) < 0.02;
      values.push_back(is_lost ? 6 : std::uint32_t(std::lround(1e3 * wall(i))));
    }
    text += test::scip_scan(fmt::format("MD02840484000{:02}", 99 - s), values);
  }
  folder.file("r.scip", text);
  const auto r = compare("s.yaml --against r.scip --csv t.csv");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("error codes of the recorded scanner, of all readings: 6: "), std::string::npos) << r.output;
  EXPECT_NEAR(figure("recorded", "drop_outs"), 0.02, 3 * std::sqrt(0.02 / (100 * ray_count)));
  EXPECT_NEAR(figure("simulated", "drop_outs"), 0.05, 3 * std::sqrt(0.05 / (100 * ray_count)));
  EXPECT_NEAR(figure("recorded", "resolution"), 0.001, 1e-9);
  EXPECT_NEAR(figure("simulated", "resolution"), 0.001, 1e-9);
}

TEST_F(AgainstScans, WhatTheRecordDoesNotSayIsTakenFromTheScanner) {
  folder.file("s.yaml", scenario("sigma: 0.004"));
  std::string text = "time";
  for (int i = 0; i < ray_count; ++i) text += fmt::format(",stand/laser:ranges.measured[{}]", i);
  for (int s = 0; s < 20; ++s) {
    text += fmt::format("\n{}", s);
    for (int i = 0; i < ray_count; ++i) text += i < 20 ? ",5.6" : ",2";
  }
  folder.file("r.csv", text + "\n");
  const auto r = compare("s.yaml --against r.csv --csv t.csv");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("it does not say its directions; those of stand/laser are taken"), std::string::npos);
  EXPECT_NEAR(figure("recorded", "without_return"), 20.0 / ray_count, 1e-5) << "what reads max_range was not seen";
}

TEST_F(AgainstScans, MistakesAreOneMessage) {
  folder.file("s.yaml", scenario("sigma: 0.004"));
  folder.file("none.yaml",
              "robots:\n  stand:\n    shape: {box: [0.1, 0.1, 0.1]}\n    mass: 1\n    motion: {use: motion.point}\n");
  std::string scan = test::scip_scan("MD0000000200000", {1000, 1001, 1002});
  folder.file("r.scip", scan);
  ++scan[scan.size() - 5];
  folder.file("changed.scip", scan);
  folder.file("few.csv", "time,ranges[0],ranges[1],ranges[2]\n0,1,1,1\n");
  folder.file("joint.csv", "# p_gain: 1\ntime,position,goal\n");
  std::string rows = scenario("sigma: 0.004");
  rows.replace(rows.find("rays:"), 5, "rows: 2, rays:");
  folder.file("rows.yaml", rows);
  std::string beams = "time", ranges;
  for (int i = 0; i < 60; ++i) beams += ",ranges[" + std::to_string(i) + "]", ranges += ",1";
  beams += "\n";
  for (int k = 0; k < 12; ++k) beams += std::to_string(k) + ranges + "\n";
  folder.file("beams.csv", beams);
  const std::pair<std::string, std::string> cases[] = {
      {"s.yaml --against changed.scip", "changed.scip:4:10: the sum of this line does not fit"},
      {"s.yaml --against r.scip --sensor stand/lazer", "there is no such laser scanner (did you mean `stand/laser`?)"},
      {"s.yaml --against r.scip --joint stand/joint",
       "--joint is for records of a joint, and r.scip is one of a laser"},
      {"s.yaml --against joint.csv --known-map", "--known-map are for records of laser scanners"},
      {"s.yaml --against r.scip joint.csv", "has records of scans and of a joint"},
      {"s.yaml --against few.csv", "few.csv: it does not say its directions"},
      {"none.yaml --against r.scip", "the scenario has no laser scanner"},
      {"rows.yaml --against beams.csv", "rows"},
  };
  for (const auto& [arguments, message] : cases) {
    const auto r = compare(arguments);
    EXPECT_EQ(r.exit_code, 2) << r.output;
    EXPECT_NE(r.output.find(message), std::string::npos) << message << "\n" << r.output;
    EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  }
}

}  // namespace
}  // namespace muro::host
