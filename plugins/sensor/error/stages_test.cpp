// SPDX-License-Identifier: MIT
// Each stage of the chain alone, compared with its closed form.
#include <gtest/gtest.h>

#include "chain_testing.hpp"

namespace muro {
namespace {

using test::Device;
using test::readings;

// --- bandwidth

TEST(LowPass, OfFirstOrderAnswersARampExactly) {
  const double f = 3, w = 2 * M_PI * f, slope = 0.7;
  for (const double rate : {10.0, 100.0, 1000.0}) {
    const auto y = readings({.bandwidth = f}, rate, 60, [&](std::size_t k) { return slope * double(k) / rate; });
    for (std::size_t k = 0; k < y.size(); ++k) {
      const double t = double(k) / rate;
      EXPECT_NEAR(y[k], slope * (t - 1 / w + std::exp(-w * t) / w), 1e-13) << rate << " Hz, sample " << k;
    }
  }
}

TEST(LowPass, OfSecondOrderAnswersARampExactly) {
  const double f = 3, w = 2 * M_PI * f, a = w / std::sqrt(2), slope = 0.7;
  for (const double rate : {10.0, 100.0, 1000.0}) {
    const auto y = readings({.bandwidth = f, .bandwidth_order = 2}, rate, 60,
                            [&](std::size_t k) { return slope * double(k) / rate; });
    for (std::size_t k = 0; k < y.size(); ++k) {
      // solution of y'' + sqrt(2) w y' + w^2 y = w^2 slope t, at rest
      const double t = double(k) / rate, lag = std::sqrt(2) / w;
      EXPECT_NEAR(y[k], slope * (t - lag + std::exp(-a * t) * lag * std::cos(a * t)), 1e-13) << rate << " Hz";
    }
  }
}

TEST(LowPass, PassesOneOverRootTwoAtItsBandwidth) {
  for (const int order : {1, 2}) {
    const double f = 5, rate = 5000;
    const auto y = readings({.bandwidth = f, .bandwidth_order = order}, rate, 10000,
                            [&](std::size_t k) { return std::sin(2 * M_PI * f * double(k) / rate); });
    double largest = 0;
    for (std::size_t k = 8000; k < y.size(); ++k) largest = std::max(largest, std::abs(y[k]));
    EXPECT_NEAR(largest, std::sqrt(0.5), 1e-5) << "order " << order;
  }
}

TEST(LowPass, BeginsAtRestAtTheFirstReading) {
  for (const int order : {1, 2})
    for (const double y :
         readings({.bandwidth = 1, .bandwidth_order = order}, 100, 50, [](std::size_t) { return 7.5; }))
      EXPECT_NEAR(y, 7.5, 1e-14);
}

// --- scale, misalignment, g-sensitivity

TEST(Alignment, MixesTheAxesByItsMatrix) {
  ErrorSettings s;
  s.alignment.scale = PerComponent(std::vector<double>{0.1, 0.2, 0.3});
  s.alignment.misalignment = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06};
  const auto y = Device(s, 3, 100).read({1, 10, 100});
  EXPECT_NEAR(y[0], 1.1 + 0.1 + 2, 1e-12);
  EXPECT_NEAR(y[1], 0.03 + 12 + 4, 1e-12);
  EXPECT_NEAR(y[2], 0.05 + 0.6 + 130, 1e-12);
}

TEST(Alignment, AddsTheSpecificForceToAGyro) {
  ErrorSettings s;
  s.alignment.g_sensitivity << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const Vec3 force(0.1, 0.01, 0.001);
  const auto y = Device(s, 3, 100).read({10, 20, 30}, &force);
  EXPECT_NEAR(y[0], 10.123, 1e-12);
  EXPECT_NEAR(y[1], 20.456, 1e-12);
  EXPECT_NEAR(y[2], 30.789, 1e-12);
}

TEST(Alignment, DrawsToleratedErrorsOnceARun) {
  ErrorSettings s;
  s.alignment.scale_tolerance = 0.03;
  s.alignment.cross_axis_tolerance.fill(0.06);
  std::vector<double> scales, mixed;
  for (std::uint64_t seed = 1; seed <= 5000; ++seed) {
    Device device(s, 3, 100, seed);
    const auto y = device.read({1, 0, 0});
    EXPECT_EQ(device.read({1, 0, 0}), y) << "all the run";
    scales.push_back(y[0] - 1);
    mixed.push_back(y[1]);
  }
  const double error = 3 * std::sqrt(2.0 / 5000);
  EXPECT_NEAR(test::moment_of(scales, 2), 1e-4, 1e-4 * error);
  EXPECT_NEAR(test::moment_of(mixed, 2), 4e-4, 4e-4 * error);
}

// --- bias

TEST(TurnOnBias, IsNormalAndDrawnOnceARun) {
  std::vector<double> all;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Device device({.turn_on_bias_tolerance = 6}, 1, 100, seed);
    all.push_back(device.read(0));
    EXPECT_EQ(device.read(0), all.back());
  }
  EXPECT_NEAR(test::mean_of(all), 0, 3 * 2 / std::sqrt(2e4));
  EXPECT_NEAR(test::moment_of(all, 2), 4, 4 * 3 * std::sqrt(2 / 2e4));
  EXPECT_NEAR(test::moment_of(all, 4) / 16, 3, 0.25) << "uniform numbers have 1.8";
}

TEST(TurnOnBias, DiffersBetweenComponentsAndReadings) {
  const auto a = Device({.turn_on_bias_tolerance = 6}, 3, 100, 1, 1).read({0, 0, 0});
  const auto b = Device({.turn_on_bias_tolerance = 6}, 3, 100, 1, 2).read({0, 0, 0});
  EXPECT_NE(a[0], a[1]);
  EXPECT_NE(a[1], a[2]);
  EXPECT_NE(a, b);
}

TEST(BiasDrift, ScalesWithEachComponent) {
  ErrorSettings s;
  s.drift.gauss_markov_sigma = PerComponent(std::vector<double>{1, 0, 10});
  s.drift.gauss_markov_time = 0.01;
  Device device(s, 3, 100);
  std::vector<double> x, z;
  for (int k = 0; k < 20000; ++k) {
    const auto y = device.read({0, 0, 0});
    EXPECT_EQ(y[1], 0);
    x.push_back(y[0]);
    z.push_back(y[2]);
  }
  EXPECT_NEAR(test::moment_of(x, 2), 1, 0.05);
  EXPECT_NEAR(test::moment_of(z, 2), 100, 5);
}

// --- converter

TEST(Saturation, ClipsExactlyAtFullScale) {
  const ErrorSettings s{.quantiser = {.full_scale = 4.363323}};
  EXPECT_EQ(Device(s, 1, 100).read(5), 4.363323);
  EXPECT_EQ(Device(s, 1, 100).read(-1e9), -4.363323);
  EXPECT_EQ(Device(s, 1, 100).read(4.3633), 4.3633);
}

TEST(Converter, Of12BitsHasItsCodesAndNoBias) {
  const double full_scale = 10, lsb = 20.0 / 4096;
  const ErrorSettings s{.quantiser = {.full_scale = full_scale, .bits = 12}};
  const std::size_t count = 100001;
  const auto truth = [](std::size_t k) { return -9.9 + 19.8 * double(k) / 100000; };
  const auto y = readings(s, 100, count, truth);
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double code = y[k] / lsb;
    EXPECT_EQ(code, std::round(code));
    const double error = y[k] - truth(k);
    EXPECT_LE(std::abs(error), lsb / 2 * (1 + 1e-9));
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / double(count), 0, lsb / 1000);
  EXPECT_NEAR(std::sqrt(squares / double(count)), lsb / std::sqrt(12), lsb / 1000) << "uniform";
  EXPECT_EQ(Device(s, 1, 100).read(50), 2047 * lsb);
  EXPECT_EQ(Device(s, 1, 100).read(-50), -2048 * lsb);
}

TEST(Converter, HasTheErrorOfThe12BitEncoderAS5045) {
  const double step = 2 * M_PI / 4096;
  const std::size_t count = 200000;
  const auto truth = [](std::size_t k) { return 0.3 + 1e-5 * double(k); };
  const auto y = readings({.quantiser = {.resolution = step}}, 1000, count, truth);
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_NEAR(y[k] / step, std::round(y[k] / step), 1e-9);
    squares += (y[k] - truth(k)) * (y[k] - truth(k));
  }
  EXPECT_NEAR(std::sqrt(squares / double(count)), 4.43e-4, 0.02 * 4.43e-4);
}

// --- delay

TEST(Delay, Of30msAt100HzGivesTheBitsOf3SamplesEarlier) {
  const auto truth = [](std::size_t k) { return std::sin(0.37 * double(k)); };
  const auto y = readings({.delay = 0.03}, 100, 200, truth);
  for (std::size_t k = 0; k < y.size(); ++k) EXPECT_EQ(y[k], truth(k < 3 ? 0 : k - 3)) << k;
}

TEST(Delay, IsWholeSamplesAtRatesWhosePeriodIsNoBinaryNumber) {
  const auto truth = [](std::size_t k) { return std::sin(0.37 * double(k)); };
  for (const int m : {1, 7, 1000}) {
    const auto y = readings({.delay = m / 300.0}, 300, 1500, truth);
    for (std::size_t k = std::size_t(m); k < y.size(); ++k) EXPECT_EQ(y[k], truth(k - std::size_t(m)));
  }
}

TEST(Delay, BetweenSamplesIsThatOfTheOlderOne) {
  const auto truth = [](std::size_t k) { return double(k * k); };
  const auto y = readings({.delay = 0.0225}, 100, 50, truth);
  for (std::size_t k = 3; k < y.size(); ++k) EXPECT_EQ(y[k], truth(k - 3)) << k;
  const auto short_one = readings({.delay = 0.004}, 100, 50, truth);
  for (std::size_t k = 1; k < short_one.size(); ++k) EXPECT_EQ(short_one[k], truth(k - 1)) << k;
}

// PX4's GPS has a delay of 0.12 s at 5 Hz
TEST(Delay, BetweenSamplesKeepsDeviationAndCodes) {
  ErrorSettings s{.quantiser = {.resolution = 0.01}, .delay = 0.12};
  s.noise.sigma = 1;
  const auto y = readings(s, 5, 20000, [](std::size_t) { return 0.0; });
  double squares = 0, products = 0;
  for (std::size_t k = 1; k < y.size(); ++k) {
    squares += y[k] * y[k], products += y[k] * y[k - 1];
    EXPECT_NEAR(y[k], 0.01 * std::round(y[k] / 0.01), 1e-12);
  }
  EXPECT_NEAR(squares / double(y.size()), 1, 3 * std::sqrt(2.0 / double(y.size())) + 1e-3);
  EXPECT_NEAR(products / squares, 0, 3 / std::sqrt(double(y.size())));
}

// --- dropouts

TEST(Dropouts, HaveTheirRateAndHoldTheReadingBefore) {
  const double p = 0.12;
  const auto y =
      readings({.dropouts = {.probability = p, .hold = true}}, 100, 50000, [](std::size_t k) { return double(k); });
  std::size_t lost = 0;
  for (std::size_t k = 1; k < y.size(); ++k) {
    if (y[k] == double(k)) continue;
    ++lost;
    EXPECT_EQ(y[k], y[k - 1]);
  }
  EXPECT_NEAR(double(lost) / 5e4, p, 3 * std::sqrt(p * (1 - p) / 5e4));
  EXPECT_EQ(y[0], 0);
}

TEST(Dropouts, LoseTheComponentsOfAVectorTogether) {
  Device device({.dropouts = {.probability = 0.3, .value = -1, .together = true}}, 3, 100);
  int lost = 0;
  for (int k = 0; k < 5000; ++k) {
    const auto y = device.read({1, 2, 3});
    lost += y[0] == -1;
    EXPECT_TRUE(y == std::vector<double>({1, 2, 3}) || y == std::vector<double>({-1, -1, -1}));
  }
  EXPECT_NEAR(lost / 5000.0, 0.3, 3 * std::sqrt(0.21 / 5000));
}

}  // namespace
}  // namespace muro
