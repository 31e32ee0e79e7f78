// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "muro/base/elementary.hpp"

namespace muro {

/// One of the Gauss-Markov processes whose sum is flicker noise.
struct FlickerProcess {
  double time = 0;   ///< s, time constant of its autocorrelation exp(-lag / time)
  double sigma = 0;  ///< stationary standard deviation for a bias instability of 1
};

/// Flicker noise of bias instability 1 as a sum of independent Gauss-Markov processes. Their times T_k form a geometric
/// progression of ratio r, at most 8. The spectrum B^2 / (pi f) (one-sided; IEEE Std 952, annex C: B^2 / (2 pi f),
/// two-sided) is the integral of spectra 4 s^2 T / (1 + (2 pi f T)^2) over ln T with s^2 = B^2 / pi. The sum is the
/// rectangle rule for it: s_k^2 = B^2 ln(r) / pi. The Allan deviation of each process peaks at 1.8926 T_k. The first
/// peak is at half of `from`, the last at twice `to`. These two also replace the processes beyond them, with a factor
/// of the variance that is fitted for the flattest sum, 2 - 0.37 ln r. Between `from` and `to` (s) the Allan deviation
/// is sqrt(2 ln 2 / pi) B = 0.664 B within 2.5 %.
inline std::vector<FlickerProcess> flicker_processes(double from, double to) {
  constexpr double peak = 1.8926, beyond = 2, widest = 8;
  const double first = from / (peak * beyond), last = to * beyond / peak;
  const double log_range = elementary::log(last / first);
  const int steps = std::max(1, int(std::ceil(log_range / elementary::log(widest) - 1e-9)));
  std::vector<FlickerProcess> all;
  const double log_ratio = log_range / steps, edge = 2 - 0.37 * log_ratio;
  for (int k = 0; k <= steps; ++k) {
    const double share = k == 0 || k == steps ? edge : 1;
    all.push_back({first * elementary::exp(log_ratio * k), std::sqrt(share * log_ratio / M_PI)});
  }
  return all;
}

}  // namespace muro
