// SPDX-License-Identifier: MIT
// The estimate of `muro sensors allan` and its expected values, compared with closed forms.
#include "host/tools/sensors/allan_deviation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace muro::host {
namespace {

TEST(AllanEstimate, MeetsAHandComputedExample) {
  // clusters of 1: differences 1, 3, -2, 2, ...; Riley, NIST SP 1065, equation 10, computed by hand
  const std::vector<double> y{1, 2, 5, 3, 5, 5, 4, 6, 7, 7};
  const std::vector<AllanPoint> points = allan_deviation(y, 0.5);
  ASSERT_EQ(points.size(), 2U) << "clusters of at most a fifth of the samples";
  EXPECT_EQ(points[1].cluster, 2U);
  EXPECT_EQ(points[1].tau, 1);
  double one = 0, two = 0;
  for (std::size_t k = 0; k + 1 < y.size(); ++k) one += std::pow(y[k + 1] - y[k], 2);
  for (std::size_t k = 0; k + 3 < y.size(); ++k) two += std::pow((y[k + 2] + y[k + 3] - y[k] - y[k + 1]) / 2, 2);
  EXPECT_NEAR(points[0].deviation, std::sqrt(one / (2 * 9)), 1e-14);
  EXPECT_NEAR(points[1].deviation, std::sqrt(two / (2 * 7)), 1e-14);
}

TEST(AllanEstimate, DoesNotSeeAConstantBias) {
  const std::vector<double> y(100, 1e6);
  for (const AllanPoint& p : allan_deviation(y, 1)) EXPECT_EQ(p.deviation, 0);
}

TEST(ExpectedAllan, HasTheClosedFormsOfItsProcesses) {
  EXPECT_DOUBLE_EQ((NoiseFigures{.noise_density = 1e-3}.deviation(400, 0.01)), 0.5e-3);
  EXPECT_NEAR((NoiseFigures{.random_walk = 0.3}.deviation(1000, 0.01)), 0.3 * std::sqrt(10.0 / 3), 1e-6);
  EXPECT_NEAR((NoiseFigures{.resolution = 0.1}.deviation(100, 1)), 0.1 / std::sqrt(1200), 1e-15);
  EXPECT_NEAR((NoiseFigures{.noise_density = 3, .resolution = std::sqrt(12) * 4}.deviation(1, 1)), 5, 1e-12);
  // Gauss-Markov: 0.6174 s at 1.8926 T, at any period
  for (const double period : {1e-3, 1e-2, 0.1})
    EXPECT_NEAR((NoiseFigures{.gauss_markov_sigma = 2, .gauss_markov_time = 50}.deviation(
                    std::size_t(std::lround(1.8926 * 50 / period)), period)),
                0.6174 * 2, 1e-3);
  const NoiseFigures flicker{.bias_instability = 1, .flicker_from = 1, .flicker_to = 1000};
  for (const double tau : {1.0, 10.0, 100.0, 1000.0})
    EXPECT_NEAR(flicker.deviation(std::size_t(tau * 1000), 1e-3), 0.66428, 0.025);
  EXPECT_NEAR(flicker.flicker(), 0.66428, 1e-5);
}

TEST(ExpectedAllan, OfASlowBiasIsThatOfARandomWalkAtFirst) {
  const double s = 2, t = 1e6, k = s * std::sqrt(2 / t);
  const NoiseFigures slow{.gauss_markov_sigma = s, .gauss_markov_time = t}, walk{.random_walk = k};
  for (const std::size_t m : {1, 10, 1000, 50000})
    EXPECT_NEAR(slow.deviation(m, 0.01) / walk.deviation(m, 0.01), 1, 1e-3) << m;
  // where another formula begins
  EXPECT_NEAR(slow.deviation(1000001, 0.01) / slow.deviation(999999, 0.01), 1, 1e-4);
}

TEST(AllanEstimate, LiesInItsBandAsOftenAsItShould) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int inside = 0, all = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<double> y(2000);
    for (double& v : y) v = normal(random);
    for (const AllanPoint& p : allan_deviation(y, 1)) {
      const double expected = NoiseFigures{.noise_density = 1}.deviation(p.cluster, 1);
      inside += std::abs(p.deviation - expected) <= 2 * expected * allan_error(y.size(), p.cluster);
      ++all;
    }
  }
  EXPECT_GT(double(inside) / all, 0.90);
  EXPECT_LT(double(inside) / all, 0.995);
}

}  // namespace
}  // namespace muro::host
