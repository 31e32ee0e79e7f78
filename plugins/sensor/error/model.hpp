// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "muro/toolkit/elementary.hpp"
#include "muro/toolkit/random.hpp"

namespace muro {

/// From the true readings x to what a device reports, y. Deviations, bias and limits have the unit of the reading.
///
///     n_0 = e_0,  n_i = c n_(i-1) + sqrt(1 - c^2) e_i     e_i independent, standard normal
///     y_i = x_i + bias + n_i sqrt(sigma^2 + (sigma_relative x_i)^2 + (pointing x_i tan a_i)^2)
///
/// with a_i the angle of incidence: a ray whose direction is off by the small angle d reads a plane x d tan a farther
/// away. Then y is rounded to the nearest multiple of `resolution`, limited to [minimum, maximum], and with the
/// probability `dropout` replaced by `dropout_value`. n is a first-order autoregressive process that starts in its
/// stationary distribution: its variance is 1 at every i, and the correlation of n_i and n_j is c^|i-j| (Box, Jenkins
/// and Reinsel: Time Series Analysis, Section 3.2).
struct ErrorModel {
  double sigma = 0;           ///< >= 0
  double sigma_relative = 0;  ///< >= 0, of the reading
  double pointing = 0;        ///< rad, >= 0: standard deviation of the direction of a ray
  double correlation = 0;     ///< c, -1 .. 1
  double bias = 0;
  double resolution = 0;  ///< >= 0; 0: not rounded
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  double dropout = 0;  ///< 0 .. 1
  double dropout_value = 0;
  /// Readings from here on mean that no echo came back: they get neither bias nor noise.
  double no_echo_from = std::numeric_limits<double>::infinity();
  static constexpr double max_incidence = 1.5;  ///< rad: rays at a larger angle are no noisier

  /// `truth` and `measured` are of equal length; `incidence` (rad) is so too, or is empty; `random` belongs to this
  /// item and step.
  void apply(std::span<const double> truth, std::span<double> measured, const Random& random,
             std::span<const double> incidence = {}) const {
    const bool noisy = sigma > 0 || sigma_relative > 0 || pointing > 0;
    const double innovation = std::sqrt(1 - correlation * correlation);
    NormalNumbers numbers(random, truth.size());
    double n = 0;
    for (std::uint32_t i = 0; i < truth.size(); ++i) {
      if (noisy) {
        const double e = numbers.next();
        n = i == 0 ? e : correlation * n + innovation * e;
      }
      double y = truth[i];
      if (y < no_echo_from) {
        const double relative_pointing =
            incidence.empty() ? 0 : pointing * elementary::tan(std::min(incidence[i], max_incidence));
        y += bias + n * std::sqrt(sigma * sigma +
                                  (sigma_relative * sigma_relative + relative_pointing * relative_pointing) * y * y);
      }
      if (resolution > 0) y = resolution * std::round(y / resolution);
      y = std::min(std::max(y, minimum), maximum);
      measured[i] = dropout > 0 && random.uniform(i) < dropout ? dropout_value : y;
    }
  }
};

}  // namespace muro
