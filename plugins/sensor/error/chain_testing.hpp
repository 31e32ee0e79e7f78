// SPDX-License-Identifier: MIT
// Runs a chain of errors, and estimates statistics of its readings.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "error_chain.hpp"

namespace muro::test {

/// A device that is read at a fixed rate.
class Device {
 public:
  Device(const ErrorSettings& settings, std::size_t components, double rate, std::uint64_t seed = 1,
         std::uint64_t key = 1)
      : chain_(settings, components, rate > 0 ? 1 / rate : 0, key), state_(chain_.state_size()), seed_(seed) {}

  std::vector<double> read(const std::vector<double>& truth, const Vec3* force = nullptr) {
    std::vector<double> measured(truth.size());
    chain_.apply(truth, measured, state_, {.seed = seed_, .index = index_++, .specific_force = force});
    return measured;
  }
  double read(double truth) {
    double measured = 0;
    chain_.apply({&truth, 1}, {&measured, 1}, state_, {.seed = seed_, .index = index_++});
    return measured;
  }

 private:
  ErrorChain chain_;
  std::vector<double> state_;
  std::uint64_t seed_, index_ = 0;
};

/// Returns the readings that a device of one component makes of `truth(k)`, sample by sample.
inline std::vector<double> readings(const ErrorSettings& settings, double rate, std::size_t count,
                                    const std::function<double(std::size_t)>& truth, std::uint64_t seed = 1) {
  Device device(settings, 1, rate, seed);
  std::vector<double> all(count);
  for (std::size_t k = 0; k < count; ++k) all[k] = device.read(truth(k));
  return all;
}
inline std::vector<double> readings_at_rest(const ErrorSettings& settings, double rate, std::size_t count,
                                            std::uint64_t seed = 1) {
  return readings(
      settings, rate, count, [](std::size_t) { return 0.0; }, seed);
}

inline double mean_of(const std::vector<double>& y) {
  double sum = 0;
  for (const double v : y) sum += v;
  return sum / double(y.size());
}

/// Returns the central moment.
inline double moment_of(const std::vector<double>& y, int power) {
  const double mean = mean_of(y);
  double sum = 0;
  for (const double v : y) sum += std::pow(v - mean, power);
  return sum / double(y.size());
}

/// Overlapping Allan variance of clusters of m samples (Riley: Handbook of Frequency Stability Analysis,
/// section 5.2.4).
inline double allan_variance(const std::vector<double>& y, std::size_t m) {
  std::vector<double> sums(y.size() + 1, 0.0);
  for (std::size_t k = 0; k < y.size(); ++k) sums[k + 1] = sums[k] + y[k];
  double sum = 0;
  const std::size_t count = y.size() + 1 - 2 * m;
  for (std::size_t k = 0; k < count; ++k) {
    const double d = (sums[k + 2 * m] - 2 * sums[k + m] + sums[k]) / double(m);
    sum += d * d;
  }
  return sum / (2 * double(count));
}

/// Standard deviation of the estimate of an Allan deviation, relative to it (IEEE Std 952, annex C).
inline double allan_error(std::size_t samples, std::size_t m) {
  return std::sqrt(1 / (2 * (double(samples) / double(m) - 1)));
}

}  // namespace muro::test
