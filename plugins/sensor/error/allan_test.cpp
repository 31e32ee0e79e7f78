// SPDX-License-Identifier: MIT
// Allan deviations of simulated devices, compared with the closed forms of their processes. Bounds are three standard
// deviations of the estimate; seeds are fixed.
#include <gtest/gtest.h>

#include "chain_testing.hpp"

namespace muro {
namespace {

using test::allan_error;
using test::allan_variance;
using test::readings_at_rest;

void expect_allan(const std::vector<double>& y, std::size_t m, double variance, double also = 0) {
  const double expected = std::sqrt(variance);
  EXPECT_NEAR(std::sqrt(allan_variance(y, m)), expected, expected * (3 * allan_error(y.size(), m) + also)) << "m " << m;
}

/// Allan variance of a first-order autoregressive process with innovations of standard deviation u (Zhang 2008).
double autoregressive_allan(double phi, double u, double m) {
  const double numerator = m - 3 * phi - m * phi * phi + 4 * std::pow(phi, m + 1) - std::pow(phi, 2 * m + 1);
  return u * u * numerator / (m * m * (1 - phi) * (1 - phi) * (1 - phi * phi));
}

TEST(AllanDeviation, OfWhiteNoiseFallsWithTheRootOfTime) {
  const ErrorSettings settings{.noise = {.density = 1e-3}};
  const std::vector<double> y = readings_at_rest(settings, 100, 1000000);
  EXPECT_NEAR(std::sqrt(test::moment_of(y, 2)), 0.01, 0.01 * 3 / std::sqrt(2e6));
  for (const std::size_t m : {1, 10, 100, 1000, 10000}) expect_allan(y, m, 1e-6 / (double(m) / 100));
}

TEST(AllanDeviation, OfWhiteNoiseIsTheSameAtEveryRate) {
  for (const double rate : {1.0, 10.0, 1000.0}) {
    const std::vector<double> y = readings_at_rest({.noise = {.density = 1e-3}}, rate, 200000);
    expect_allan(y, std::size_t(rate), 1e-6);
    expect_allan(y, std::size_t(20 * rate), 1e-6 / 20);
  }
}

TEST(AllanDeviation, OfNoiseOfASampleFollowsTheRate) {
  const std::vector<double> y = readings_at_rest({.noise = {.sigma = 0.01}}, 10, 200000);
  for (const std::size_t m : {1, 10, 100}) expect_allan(y, m, 1e-4 / double(m));
}

TEST(AllanDeviation, OfARandomWalkRisesWithTheRootOfTime) {
  const double k = 0.02;
  for (const double rate : {10.0, 100.0}) {
    const std::vector<double> y = readings_at_rest({.drift = {.random_walk = k}}, rate, 200000);
    for (const std::size_t m : {1, 10, 100, 1000}) {
      const double u = k / std::sqrt(rate), n = double(m);
      expect_allan(y, m, u * u * (2 * n * n + 1) / (6 * n));
    }
    const double t = 10;
    expect_allan(y, std::size_t(t * rate), k * k * t / 3, 0.001);
  }
}

TEST(AllanDeviation, OfARandomWalkHasTheVarianceK2T) {
  std::vector<double> ends;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed)
    ends.push_back(readings_at_rest({.drift = {.random_walk = 0.1}}, 10, 91, seed).back());
  EXPECT_NEAR(test::moment_of(ends, 2), 0.01 * 9, 0.09 * 3 * std::sqrt(2.0 / 2000));
}

TEST(AllanDeviation, OfAGaussMarkovBiasMeetsTheClosedForm) {
  const double s = 0.3, t = 2;
  for (const double rate : {5.0, 50.0}) {
    const std::vector<double> y =
        readings_at_rest({.drift = {.gauss_markov_sigma = s, .gauss_markov_time = t}}, rate, 400000);
    const double phi = std::exp(-1 / (rate * t)), u = s * std::sqrt(1 - phi * phi);
    for (const double tau : {0.4, 2.0, 10.0, 60.0}) {
      const auto m = std::size_t(std::lround(tau * rate));
      expect_allan(y, m, autoregressive_allan(phi, u, double(m)));
    }
  }
}

TEST(AllanDeviation, OfAGaussMarkovBiasPeaksAt1p8926T) {
  const double s = 0.3, t = 2, rate = 50;
  const std::vector<double> y =
      readings_at_rest({.drift = {.gauss_markov_sigma = s, .gauss_markov_time = t}}, rate, 1000000);
  const auto deviation = [&](double tau) { return std::sqrt(allan_variance(y, std::size_t(std::lround(tau * rate)))); };
  expect_allan(y, std::size_t(std::lround(1.8926 * t * rate)), 0.6174 * 0.6174 * s * s);
  for (const double factor : {0.4, 2.5}) EXPECT_LT(deviation(1.8926 * t * factor), deviation(1.8926 * t));
}

TEST(AllanDeviation, OfFlickerIsFlatAt0p664B) {
  const double b = 0.05;
  const ErrorSettings settings{.drift = {.bias_instability = b, .flicker_from = 0.5, .flicker_to = 50}};
  const std::vector<double> y = readings_at_rest(settings, 50, 1000000);
  for (const double tau : {0.5, 1.0, 3.0, 10.0, 30.0, 50.0})
    expect_allan(y, std::size_t(std::lround(tau * 50)), 2 * std::log(2) / M_PI * b * b, 0.025);
}

TEST(AllanDeviation, OfFlickerIsFlatWithin2p5PercentInTheory) {
  // Gauss-Markov, continuous: s^2 (2 T / t) (1 - T / (2 t) (3 - 4 exp(-t / T) + exp(-2 t / T)))
  for (const double decades : {0.0, 0.5, 0.9, 1.0, 2.0, 3.0, 4.0, 6.0}) {
    const double to = std::pow(10, decades);
    for (int i = 0; i <= 200; ++i) {
      const double t = std::pow(to, i / 200.0);
      double variance = 0;
      for (const FlickerProcess& p : flicker_processes(1, to)) {
        const double x = p.time / t;
        variance += p.sigma * p.sigma * 2 * x * (1 - x / 2 * (3 - 4 * std::exp(-1 / x) + std::exp(-2 / x)));
      }
      EXPECT_NEAR(std::sqrt(variance / (2 * std::log(2) / M_PI)), 1, 0.025) << decades << " decades, at " << t;
    }
  }
}

TEST(AllanDeviation, OfAResolutionIsThatOfWhiteNoise) {
  const double step = 0.01;
  const auto truth = [](std::size_t k) { return 20 * Random(9, 9, k).uniform(0); };
  std::vector<double> y = test::readings({.quantiser = {.resolution = step}}, 100, 200000, truth);
  for (std::size_t k = 0; k < y.size(); ++k) y[k] -= truth(k);
  for (const std::size_t m : {1, 10, 100}) expect_allan(y, m, step * step / (12 * double(m)));
}

/// Returns the correlation at a lag, about the true mean 0.
double correlation_at(const std::vector<double>& y, std::size_t lag) {
  double sum = 0;
  for (std::size_t k = lag; k < y.size(); ++k) sum += y[k] * y[k - lag];
  return sum / double(y.size() - lag);
}

// hector's plugin multiplies the driving noise by the period; PX4's bias decays by 1/60 an update at any period
TEST(GaussMarkovBias, HasOneAutocorrelationAt1HzAndAt10Hz) {
  const double s = 2, t = 8, duration = 60000;
  for (const double rate : {1.0, 10.0}) {
    const std::vector<double> y = readings_at_rest({.drift = {.gauss_markov_sigma = s, .gauss_markov_time = t}}, rate,
                                                   std::size_t(duration * rate));
    for (const double lag : {0.0, 4.0, 8.0, 24.0}) {
      const double decayed = std::exp(-2 * lag / t);
      const double error = s * s * std::sqrt((t + decayed * (2 * lag + t)) / duration);  // Bartlett
      EXPECT_NEAR(correlation_at(y, std::size_t(lag * rate)), s * s * std::exp(-lag / t), 3 * error)
          << rate << " Hz, lag " << lag;
    }
  }
}

// Pegasus uses uniform instead of normal numbers
TEST(GaussMarkovBias, IsNormal) {
  std::vector<double> starts, later;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    const auto y = readings_at_rest({.drift = {.gauss_markov_sigma = 2, .gauss_markov_time = 1}}, 1, 2, seed);
    starts.push_back(y[0]);
    later.push_back(y[1] - std::exp(-1) * y[0]);
  }
  const double step = 4 * (1 - std::exp(-2));
  EXPECT_NEAR(test::moment_of(starts, 2), 4, 4 * 3 * std::sqrt(2 / 2e4)) << "stationary from the start";
  EXPECT_NEAR(test::moment_of(later, 2), step, step * 3 * std::sqrt(2 / 2e4));
  for (const auto* y : {&starts, &later}) {
    const double variance = test::moment_of(*y, 2);
    EXPECT_NEAR(test::moment_of(*y, 4) / (variance * variance), 3, 4 * std::sqrt(24 / 2e4)) << "uniform: 1.8";
  }
}

}  // namespace
}  // namespace muro
