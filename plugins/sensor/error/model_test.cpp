// SPDX-License-Identifier: MIT
// Noise, bias, resolution, limits and dropouts of an array, compared with the theory of their processes. Seeds are
// fixed; bounds are 5 standard deviations of the estimate. So a wrong model fails, and a right one passes with any
// seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "error_chain.hpp"

namespace muro {
namespace {

using Words = std::array<std::uint32_t, 4>;

/// The errors of a scan.
struct ScanErrors {
  double sigma = 0, sigma_relative = 0, correlation = 0, bias = 0, resolution = 0;
  double minimum = -std::numeric_limits<double>::infinity(), maximum = std::numeric_limits<double>::infinity();
  double dropout = 0, dropout_value = 0, no_echo_from = std::numeric_limits<double>::infinity();

  void apply(const std::vector<double>& x, std::vector<double>& y, const ErrorChain::Sample& sample,
             std::uint64_t key) const {
    ErrorSettings s;
    s.bias = bias;
    s.noise = {.sigma = sigma, .sigma_relative = sigma_relative, .correlation = correlation};
    s.quantiser = {.resolution = resolution, .minimum = minimum, .maximum = maximum};
    s.dropouts = {.probability = dropout, .value = dropout_value};
    s.no_echo_from = no_echo_from;
    const ErrorChain chain(s, x.size(), 0.1, key);
    EXPECT_EQ(chain.state_size(), 0U) << "nothing here has a memory";
    chain.apply(x, y, {}, sample);
  }
};

/// Returns `steps` readings of `length` true values of `truth`, one step after the other.
std::vector<double> measure(const ScanErrors& model, double truth, std::uint32_t length, std::uint64_t steps,
                            std::uint64_t key = 1, std::uint64_t seed = 1) {
  const std::vector<double> x(length, truth);
  std::vector<double> all;
  for (std::uint64_t k = 0; k < steps; ++k) {
    std::vector<double> y(length);
    model.apply(x, y, {.seed = seed, .index = k}, key);
    all.insert(all.end(), y.begin(), y.end());
  }
  return all;
}

double mean(const std::vector<double>& y) {
  double sum = 0;
  for (const double v : y) sum += v;
  return sum / double(y.size());
}

double variance(const std::vector<double>& y) {
  const double m = mean(y);
  double sum = 0;
  for (const double v : y) sum += (v - m) * (v - m);
  return sum / double(y.size() - 1);
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double ma = mean(a), mb = mean(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - ma) * (b[i] - mb);
  return sum / double(a.size() - 1) / std::sqrt(variance(a) * variance(b));
}

/// Returns the correlation of readings `lag` places apart within an array, over all steps.
double autocorrelation(const std::vector<double>& y, std::uint32_t length, std::uint32_t lag) {
  std::vector<double> a, b;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (i % length + lag < length) {
      a.push_back(y[i]);
      b.push_back(y[i + lag]);
    }
  return correlation(a, b);
}

TEST(Philox, GivesTheKnownAnswersOfTheRandom123Distribution) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  // digits of pi
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomNumbers, ComeInPairsOfIndependentStandardNormals) {
  const std::uint32_t n = 200000;
  std::vector<double> first(n), second(n);
  const Random random(3, 4, 5);
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto pair = random.normal_pair(i);
    first[i] = pair[0];
    second[i] = pair[1];
    EXPECT_EQ(random.normal(i), pair[0]);
  }
  for (const auto* x : {&first, &second}) {
    EXPECT_NEAR(mean(*x), 0, 5 / std::sqrt(n));
    EXPECT_NEAR(variance(*x), 1, 5 * std::sqrt(2.0 / n));
    const auto beyond_two = std::count_if(x->begin(), x->end(), [](double v) { return std::abs(v) > 2; });
    EXPECT_NEAR(double(beyond_two) / n, 0.0455003, 5 * std::sqrt(0.0455 * 0.9545 / n));
  }
  EXPECT_NEAR(correlation(first, second), 0, 5 / std::sqrt(n));
}

TEST(SensorErrorModel, ChangesNothingByDefault) {
  const std::vector<double> x = {0, 1.5, -3, 1e9};
  std::vector<double> y(4);
  ScanErrors{}.apply(x, y, {.seed = 1}, 1);
  EXPECT_EQ(y, x);
}

TEST(SensorErrorModel, AddsNoiseOfTheGivenDeviationAndBias) {
  const double n = 682 * 300;
  const std::vector<double> y = measure({.sigma = 0.03, .bias = 0.01}, 2, 682, 300);
  EXPECT_NEAR(mean(y), 2.01, 5 * 0.03 / std::sqrt(n));
  EXPECT_NEAR(variance(y), 9e-4, 5 * 9e-4 * std::sqrt(2 / n));
  EXPECT_NEAR(autocorrelation(y, 682, 1), 0, 5 / std::sqrt(n));
}

TEST(SensorErrorModel, AddsConstantAndRelativeNoiseAsIndependentSources) {
  const double n = 682 * 300, expected = 0.03 * 0.03 + 0.01 * 0.01 * 16;
  EXPECT_NEAR(variance(measure({.sigma = 0.03, .sigma_relative = 0.01}, 4, 682, 300)), expected,
              5 * expected * std::sqrt(2 / n));
  EXPECT_NEAR(variance(measure({.sigma_relative = 0.01}, -4, 682, 300)), 0.0016, 5 * 0.0016 * std::sqrt(2 / n));
}

TEST(SensorErrorModel, CorrelatesNeighboursWithoutChangingTheDeviation) {
  const std::uint32_t length = 100, steps = 4000;
  for (const double c : {0.52, -0.4, 0.9}) {
    const std::vector<double> y = measure({.sigma = 0.5, .correlation = c}, 0, length, steps);
    // for the variance a correlated sequence is equivalent to n (1 - c^2) / (1 + c^2) independent numbers
    const double n = double(length) * steps, worth = n * (1 - c * c) / (1 + c * c);
    EXPECT_NEAR(variance(y), 0.25, 5 * 0.25 * std::sqrt(2 / worth)) << c;
    EXPECT_NEAR(mean(y), 0, 5 * 0.5 * std::sqrt((1 + std::abs(c)) / (1 - std::abs(c)) / n)) << c;
    for (std::uint32_t lag = 1; lag <= 3; ++lag)
      EXPECT_NEAR(autocorrelation(y, length, lag), std::pow(c, lag), 5 / std::sqrt(worth)) << c << ' ' << lag;
    // stationary from the first place on
    for (const std::uint32_t place : {0u, 1u, 99u}) {
      std::vector<double> at;
      for (std::uint32_t k = 0; k < steps; ++k) at.push_back(y[k * length + place]);
      EXPECT_NEAR(variance(at), 0.25, 5 * 0.25 * std::sqrt(2.0 / steps)) << c << ' ' << place;
    }
  }
}

TEST(SensorErrorModel, ShiftsAWholeReadingWhenNeighboursAreFullyCorrelated) {
  const std::vector<double> y = measure({.sigma = 1, .correlation = 1}, 0, 50, 2);
  for (int i = 1; i < 50; ++i) EXPECT_EQ(y[i], y[0]);
  EXPECT_NE(y[50], y[0]);
}

TEST(SensorErrorModel, RoundsToTheGrid) {
  const double step = 0.01;
  const std::vector<double> y = measure({.sigma = 0.05, .resolution = step}, 1.2345, 682, 100);
  for (const double v : y) EXPECT_NEAR(v / step, std::round(v / step), 1e-9);
  // Widrow: with noise well above the step, rounding adds the variance step^2 / 12 and no bias
  const double n = double(y.size()), expected = 0.0025 + step * step / 12;
  EXPECT_NEAR(mean(y), 1.2345, 5 * std::sqrt(expected / n));
  EXPECT_NEAR(variance(y), expected, 5 * expected * std::sqrt(2 / n));
  EXPECT_EQ(measure({.resolution = 0.5}, 1.26, 1, 1)[0], 1.5);
  EXPECT_EQ(measure({.resolution = 0.5}, -1.24, 1, 1)[0], -1);
}

TEST(SensorErrorModel, StaysWithinItsLimits) {
  const std::vector<double> y = measure({.sigma = 0.1, .minimum = 0.95, .maximum = 1.1}, 1, 682, 100);
  int low = 0, high = 0;
  for (const double v : y) {
    EXPECT_GE(v, 0.95);
    EXPECT_LE(v, 1.1);
    low += v == 0.95;
    high += v == 1.1;
  }
  const double n = double(y.size()), below = 0.3085375, above = 0.1586553;  // normal tails beyond 0.5 and 1 sigma
  EXPECT_NEAR(low / n, below, 5 * std::sqrt(below * (1 - below) / n));
  EXPECT_NEAR(high / n, above, 5 * std::sqrt(above * (1 - above) / n));
}

TEST(SensorErrorModel, LosesReadingsAtTheGivenRate) {
  const std::uint32_t length = 682, steps = 200;
  for (const double p : {0.12, 0.006}) {
    const std::vector<double> y = measure({.sigma = 0.1, .dropout = p, .dropout_value = -1}, 2, length, steps);
    std::vector<double> lost;
    for (const double v : y) lost.push_back(v == -1);
    const double n = double(length) * steps;
    EXPECT_NEAR(mean(lost), p, 5 * std::sqrt(p * (1 - p) / n)) << "binomial";
    EXPECT_NEAR(autocorrelation(lost, length, 1), 0, 5 / std::sqrt(n)) << "independent of the neighbour";
  }
  EXPECT_EQ(measure({.dropout = 1, .dropout_value = 0}, 2, 10, 1), std::vector<double>(10, 0.0));
  EXPECT_EQ(measure({.minimum = 1, .dropout = 1, .dropout_value = 0}, 2, 1, 1)[0], 0) << "may lie outside the limits";
}

TEST(SensorErrorModel, LeavesAReadingWithoutEchoAlone) {
  const ScanErrors model{.sigma = 0.1, .bias = 0.5, .maximum = 5.6, .no_echo_from = 5.6};
  for (const double v : measure(model, 5.6, 100, 1)) EXPECT_EQ(v, 5.6);
  for (const double v : measure(model, 4, 100, 1)) EXPECT_NE(v, 4);
}

TEST(SensorErrorModel, GivesTheSameNumbersForTheSameSeedItemAndStep) {
  const ScanErrors model{.sigma = 0.1, .correlation = 0.5, .dropout = 0.1};
  EXPECT_EQ(measure(model, 2, 100, 20, 7, 9), measure(model, 2, 100, 20, 7, 9));
  const std::vector<double> x(100, 2);
  std::vector<double> early(100), late(100);
  model.apply(x, late, {.seed = 9, .index = 19}, 7);
  model.apply(x, early, {.seed = 9, .index = 3}, 7);
  const std::vector<double> all = measure(model, 2, 100, 20, 7, 9);
  EXPECT_TRUE(std::equal(early.begin(), early.end(), all.begin() + 300)) << "whatever the order of the steps";
  EXPECT_TRUE(std::equal(late.begin(), late.end(), all.begin() + 1900));
}

TEST(SensorErrorModel, GivesUncorrelatedNumbersToItemsStepsAndSeeds) {
  const ScanErrors model{.sigma = 1};
  const std::uint32_t length = 100, steps = 500;
  const double bound = 5 / std::sqrt(double(length) * steps);
  const std::vector<double> y = measure(model, 0, length, steps, 1, 1);
  EXPECT_NEAR(correlation(y, measure(model, 0, length, steps, 2, 1)), 0, bound) << "another item";
  EXPECT_NEAR(correlation(y, measure(model, 0, length, steps, 1, 2)), 0, bound) << "another seed";
  EXPECT_NEAR(correlation({y.begin(), y.end() - length}, {y.begin() + length, y.end()}), 0, bound) << "the next step";
}

}  // namespace
}  // namespace muro
