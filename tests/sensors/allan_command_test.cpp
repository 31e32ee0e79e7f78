// SPDX-License-Identifier: MIT
// `muro sensors allan` as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

struct AllanRun {
  test::ScratchFolder folder;
  test::CommandResult result;

  explicit AllanRun(const std::string& arguments, const std::string& sensor_error = "part: mti1") {
    const std::string scenario = folder.file(
        "s.yaml",
        "duration: 200\nrobots:\n  rover:\n    shape: {box: [0.4, 0.3, 0.2]}\n    mass: 5\n    motion: {use: "
        "motion.point, rate: 100}\n    imu: {use: sensor.imu, rate: 100}\n" +
            (sensor_error.empty() ? "" : "    imu_error: {use: sensor.error, on: imu, " + sensor_error + "}\n"));
    result = test::run_command("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " sensors allan " + scenario +
                               " " + arguments);
  }
};

/// Returns the numbers of the line that begins with this averaging time.
std::vector<double> row(const std::string& output, const std::string& tau) {
  std::istringstream in(output);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first != tau) continue;
    std::vector<double> numbers;
    for (std::string word; words >> word;)
      if (word != "to") numbers.push_back(std::stod(word));
    return numbers;
  }
  return {};
}

TEST(SensorsAllan, MeetsTheDataSheetOfThePart) {
  const AllanRun run("--sensor imu --reading angular_velocity");
  ASSERT_EQ(run.result.exit_code, 0) << run.result.output;
  EXPECT_SAYS(run.result.output, "angular_velocity.measured of rover/imu: 20000 samples at 100 Hz");
  EXPECT_SAYS(run.result.output, "N 0.0001222 rad/s/sqrt(Hz), B 4.848e-05 rad/s");
  const std::vector<double> numbers = row(run.result.output, "0.1");
  ASSERT_EQ(numbers.size(), 6U) << run.result.output;
  const double density = 0.007 * M_PI / 180;
  EXPECT_NEAR(numbers[3], density / std::sqrt(0.1), 0.01 * density / std::sqrt(0.1)) << "expected";
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(numbers[std::size_t(i)], numbers[3], 3 * numbers[3] / std::sqrt(4000));
}

TEST(SensorsAllan, ShowsAllReadingsWithErrors) {
  const AllanRun run("--sensor rover/imu --duration 2");
  ASSERT_EQ(run.result.exit_code, 0) << run.result.output;
  EXPECT_SAYS(run.result.output, "angular_velocity.measured of rover/imu: 200 samples");
  EXPECT_SAYS(run.result.output, "linear_acceleration.measured of rover/imu: 200 samples");
}

TEST(SensorsAllan, DrawsTheCurveWithTheLinesOfThePart) {
  AllanRun run("", "of: angular_velocity, noise_density: 0.001, random_walk: 0.0005, bias_instability: 0.001");
  const std::string picture = run.folder.path("allan.svg");
  const std::string command = "MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " sensors allan " +
                              run.folder.path("s.yaml") + " --sensor imu --duration 100 --out " + picture;
  run.result = test::run_command(command);
  ASSERT_EQ(run.result.exit_code, 0) << run.result.output;
  const std::string svg = test::text_of(picture);
  for (const char* text : {"<svg", "Allan deviation of rover/imu", "N / √τ", "0.664 B", "K √(τ / 3)", "class=\"band\""})
    EXPECT_SAYS(svg, text);
  std::size_t curves = 0;
  for (std::size_t at = 0; (at = svg.find("class=\"curve\"", at)) != std::string::npos; ++at) ++curves;
  EXPECT_EQ(curves, 3U) << "one a component";
}

TEST(SensorsAllan, LooksAtAReadingWithoutErrorsWhenAsked) {
  const AllanRun run("--sensor imu --reading angular_velocity --duration 2", "");
  ASSERT_EQ(run.result.exit_code, 0) << run.result.output;
  EXPECT_SAYS(run.result.output, "states no noise");
}

TEST(SensorsAllan, TellsOfMistakesWithExitCode2) {
  const auto said = [](const std::string& arguments, const std::string& sensor_error, const std::string& text) {
    const AllanRun run(arguments, sensor_error);
    EXPECT_EQ(run.result.exit_code, 2) << run.result.output;
    EXPECT_SAYS(run.result.output, text);
  };
  const std::string part = "part: mti1";
  said("--sensor imo", part, "--sensor imo: there is no sensor of this name whose readings are numbers");
  said("--sensor rover/imo", part, "(did you mean `rover/imu`?)");
  said("--sensor imu --reading speed", part, "there are: angular_velocity, linear_acceleration");
  said("--sensor imu", "", "`rover/imu` has no sensor.error, so its readings are true");
  said("--sensor imu --duration 0.1", part, "an Allan deviation takes at least 20");
  said("--sensor imu --out a.svg", part, "a picture shows one reading");
  said("--sensor imu --out a.png", part, "pictures are SVG files");
  said("", part, "--sensor");
}

}  // namespace
}  // namespace muro::host
