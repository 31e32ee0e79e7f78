// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace muro::host {

/// The Allan deviation of a reading at one averaging time.
struct AllanPoint {
  std::size_t cluster = 1;  ///< number of averaged samples
  double tau = 0;           ///< averaging time, s
  double deviation = 0;     ///< unit of the reading
};

/// Standard deviation of an estimate of the Allan deviation, relative to it: 1 / sqrt(2 (n / m - 1)) for n samples in
/// clusters of m (IEEE Std 952, annex C).
double allan_error(std::size_t samples, std::size_t cluster);

/// Returns the overlapping Allan deviation (Riley: Handbook of Frequency Stability Analysis, NIST SP 1065, section
/// 5.2.4) of samples at intervals of `period` (s), for clusters of 1, 2, 5, 10, 20, ... samples up to a fifth of all.
std::vector<AllanPoint> allan_deviation(std::span<const double> samples, double period);

/// White noise, flicker and drift of a reading as in a data sheet, and the Allan deviation that follows from them. A
/// value of 0 means that there is none.
struct NoiseFigures {
  double noise_density = 0;                 ///< N, unit of the reading by sqrt(Hz)
  double bias_instability = 0;              ///< B, unit of the reading
  double flicker_from = 0, flicker_to = 0;  ///< s: averaging times between which flicker is flat
  double random_walk = 0;                   ///< K, unit of the reading by s sqrt(Hz)
  double gauss_markov_sigma = 0;            ///< stationary standard deviation
  double gauss_markov_time = 0;             ///< s
  double resolution = 0;                    ///< least difference of readings

  bool is_known() const;
  /// Deviation of white noise: N / sqrt(tau).
  double white(double tau) const;
  /// Deviation of flicker: 0.664 B.
  double flicker() const;
  /// Deviation of the random walk: K sqrt(tau / 3).
  double walk(double tau) const;
  /// Sum of all variances, for clusters of samples at intervals of `period` (s), as a deviation:
  ///
  ///     white       N^2 / tau                       walk     K^2 h (2 m^2 + 1) / (6 m)
  ///     resolution  LSB^2 / (12 m), as white noise  flicker  a sum of Gauss-Markov processes
  ///     Gauss-Markov: a first-order autoregressive process (Zhang 2008, Metrologia 45, 549)
  double deviation(std::size_t cluster, double period) const;
};

}  // namespace muro::host
