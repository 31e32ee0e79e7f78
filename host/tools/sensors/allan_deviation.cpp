// SPDX-License-Identifier: MIT
#include "host/tools/sensors/allan_deviation.hpp"

#include <cmath>

#include "muro/base/elementary.hpp"
#include "muro/toolkit/flicker_noise.hpp"

namespace muro::host {

namespace {

/// Allan variance of a process of stationary deviation 1 and correlation time `time`; samples are `period` apart.
double gauss_markov_variance(double time, std::size_t cluster, double period) {
  const double m = double(cluster), x = m * period / time;
  if (x < 0.01) return -elementary::expm1(-2 * period / time) * (2 * m * m + 1) / (6 * m) * (1 - 0.75 * x);
  const double decay = elementary::exp(-period / time), d = -elementary::expm1(-period / time);
  const double sum = m - 3 * decay - m * decay * decay + 4 * elementary::exp(-(m + 1) * period / time) -
                     elementary::exp(-(2 * m + 1) * period / time);
  return sum / (m * m * d * d);
}

}  // namespace

double allan_error(std::size_t samples, std::size_t cluster) {
  return std::sqrt(1 / (2 * (double(samples) / double(cluster) - 1)));
}

std::vector<AllanPoint> allan_deviation(std::span<const double> samples, double period) {
  std::vector<double> sums(samples.size() + 1);
  double mean = 0;  // is subtracted, so that the sums stay small
  for (const double y : samples) mean += y / double(samples.size());
  for (std::size_t k = 0; k < samples.size(); ++k) sums[k + 1] = sums[k] + (samples[k] - mean);
  std::vector<AllanPoint> points;
  for (std::size_t decade = 1; decade <= samples.size() / 5; decade *= 10)
    for (const std::size_t factor : {1, 2, 5}) {
      const std::size_t m = factor * decade;
      if (m > samples.size() / 5) break;
      const std::size_t count = samples.size() + 1 - 2 * m;
      double squares = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const double difference = (sums[k + 2 * m] - 2 * sums[k + m] + sums[k]) / double(m);
        squares += difference * difference;
      }
      points.push_back({m, double(m) * period, std::sqrt(squares / (2 * double(count)))});
    }
  return points;
}

bool NoiseFigures::is_known() const {
  return noise_density > 0 || bias_instability > 0 || random_walk > 0 || gauss_markov_sigma > 0 || resolution > 0;
}

double NoiseFigures::white(double tau) const { return noise_density / std::sqrt(tau); }

double NoiseFigures::flicker() const { return std::sqrt(2 * M_LN2 / M_PI) * bias_instability; }

double NoiseFigures::walk(double tau) const { return random_walk * std::sqrt(tau / 3); }

double NoiseFigures::deviation(std::size_t cluster, double period) const {
  const double m = double(cluster), tau = m * period;
  double variance = white(tau) * white(tau) + resolution * resolution / (12 * m) +
                    random_walk * random_walk * period * (2 * m * m + 1) / (6 * m);
  if (gauss_markov_sigma > 0)
    variance += gauss_markov_sigma * gauss_markov_sigma * gauss_markov_variance(gauss_markov_time, cluster, period);
  if (bias_instability > 0)
    for (const FlickerProcess& p : flicker_processes(flicker_from, flicker_to))
      variance +=
          bias_instability * bias_instability * p.sigma * p.sigma * gauss_markov_variance(p.time, cluster, period);
  return std::sqrt(variance);
}

}  // namespace muro::host
