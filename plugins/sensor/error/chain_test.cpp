// SPDX-License-Identifier: MIT
// The order of the chain: one case for each pair of adjacent stages that changes the reading if it is exchanged.
#include <gtest/gtest.h>

#include "chain_testing.hpp"
#include "muro/algorithm.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

using test::Device;
using test::readings;

TEST(ErrorChainOrder, BandwidthComesBeforeMisalignment) {
  ErrorSettings s;
  s.bandwidth = PerComponent(std::vector<double>{1, 0, 0});  // of x only
  s.alignment.misalignment = {0, 0, 1, 0, 0, 0};             // y also reads x
  Device device(s, 3, 100);
  device.read({0, 0, 0});
  const auto y = device.read({1, 0, 0});
  EXPECT_LT(y[0], 0.1);
  EXPECT_EQ(y[1], y[0]) << "the other way round, y would read 1";
}

TEST(ErrorChainOrder, ScaleComesBeforeGSensitivity) {
  ErrorSettings s;
  s.alignment.scale = 1;
  s.alignment.g_sensitivity = 0.1 * Mat3::Identity();
  const Vec3 force(1, 0, 0);
  EXPECT_EQ(Device(s, 3, 100).read({0, 0, 0}, &force)[0], 0.1) << "the other way round: 0.2";
}

TEST(ErrorChainOrder, ScaleComesBeforeBias) {
  ErrorSettings s;
  s.alignment.scale = 1;
  s.bias = 3;
  EXPECT_EQ(Device(s, 1, 100).read(1), 5) << "the other way round: 8";
  s = {.bandwidth = 1, .bias = 3};
  EXPECT_EQ(Device(s, 1, 100).read(1), 4);
}

TEST(ErrorChainOrder, NoiseDoesNotGrowWithTheBias) {
  for (const double y :
       readings({.bias = 5, .noise = {.sigma_relative = 1}}, 100, 100, [](std::size_t) { return 0.0; }))
    EXPECT_EQ(y, 5) << "in proportion to the scaled truth, which is 0";
}

TEST(ErrorChainOrder, NoiseComesBeforeSaturation) {
  int clipped = 0;
  for (const double y :
       readings({.noise = {.sigma = 1}, .quantiser = {.full_scale = 2}}, 100, 5000, [](std::size_t) { return 2.0; })) {
    EXPECT_LE(y, 2);
    clipped += y == 2;
  }
  EXPECT_NEAR(clipped / 5000.0, 0.5, 3 * 0.5 / std::sqrt(5000));
}

TEST(ErrorChainOrder, SaturationComesBeforeResolution) {
  const Quantiser q{.full_scale = 1.04, .resolution = 0.1};
  EXPECT_DOUBLE_EQ(Device({.quantiser = q}, 1, 100).read(2), 1.0) << "the other way round: 1.04";
}

TEST(ErrorChainOrder, ResolutionComesBeforeTheLimits) {
  const Quantiser q{.resolution = 0.1, .maximum = 1.04};
  EXPECT_EQ(Device({.quantiser = q}, 1, 100).read(2), 1.04) << "the other way round: 1.0";
}

TEST(ErrorChainOrder, DelayComesBeforeDropouts) {
  const ErrorSettings early{.dropouts = {.probability = 0.5, .value = -1}};
  ErrorSettings late = early;
  late.delay = 0.03;
  const auto truth = [](std::size_t k) { return double(k); };
  const auto a = readings(early, 100, 200, truth), b = readings(late, 100, 200, truth);
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_EQ(a[k] == -1, b[k] == -1) << "lost when it would arrive, not 3 samples later";
}

// Pegasus adds no accelerometer bias, and its gyro drifts with the time constant of the accelerometer
TEST(ErrorChain, AddsEveryKindOfBiasToTheReading) {
  const auto deviation = [](const ErrorSettings& s) {
    std::vector<double> all;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) all.push_back(Device(s, 1, 1, seed).read(7));
    EXPECT_NEAR(test::mean_of(all), 7 + s.bias[0], 4 * std::sqrt(test::moment_of(all, 2) / 3000) + 1e-12);
    return std::sqrt(test::moment_of(all, 2));
  };
  const double error = 3 / std::sqrt(2 * 3000.0);
  EXPECT_EQ(deviation({.bias = 2}), 0);
  EXPECT_NEAR(deviation({.turn_on_bias_tolerance = 3}), 1, error);
  EXPECT_NEAR(deviation({.drift = {.gauss_markov_sigma = 1, .gauss_markov_time = 5}}), 1, error);
  EXPECT_GT(deviation({.drift = {.bias_instability = 1}}), 0.5);
  EXPECT_NEAR(deviation({.noise = {.sigma = 0.6, .density = 0.8}}), 1, error) << "variances add";
}

TEST(ErrorChain, DrawsIndependentNumbersForItsStages) {
  // the numbers that one stage draws do not depend on other stages
  const ErrorSettings noise{.noise = {.density = 1}};
  ErrorSettings all = noise;
  all.drift = {.gauss_markov_sigma = 1, .gauss_markov_time = 5};
  all.turn_on_bias_tolerance = 3;
  const ErrorSettings slow{.turn_on_bias_tolerance = 3, .drift = all.drift};
  const auto a = test::readings_at_rest(noise, 10, 50), b = test::readings_at_rest(slow, 10, 50);
  const auto both = test::readings_at_rest(all, 10, 50);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(both[k], a[k] + b[k], 1e-12);
}

TEST(ErrorChain, NamesWhatNeedsTheTimeBetweenReadings) {
  const std::string said = test::complaint_of<Error>([] { Device({.delay = 0.1}, 1, 0); });
  EXPECT_SAYS(said, "delay depends on the time between readings");
  EXPECT_SAYS(said, "`rate`");
}

}  // namespace
}  // namespace muro
