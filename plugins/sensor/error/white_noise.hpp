// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "muro/base/elementary.hpp"
#include "muro/base/random.hpp"
#include "per_component.hpp"

namespace muro {

/// Noise of a sample that does not depend on earlier samples.
///
///     n_0 = e_0,  n_i = c n_(i-1) + sqrt(1 - c^2) e_i     e_i independent, standard normal
///     y_i = x_i + b_i + n_i sqrt(sigma_i^2 + N_i^2 / h + (sigma_relative_i x_i)^2 + (pointing x_i tan a_i)^2
///                                + (sigma_quadratic x_i^2)^2)
///
/// with the bias b_i, the density N_i of a device that averages over its period h (the variance of the mean of white
/// noise), and the angle of incidence a_i: a ray with a direction error of the small angle d reads a plane x d tan a
/// farther away. n is a first-order autoregressive process along an array that starts in its stationary distribution:
/// its variance is 1 at every i, and the correlation of n_i and n_j is c^|i-j| (Box, Jenkins and Reinsel: Time Series
/// Analysis, section 3.2).
class WhiteNoise {
 public:
  struct Settings {
    PerComponent sigma{};           ///< >= 0, unit of the reading, of a sample
    PerComponent sigma_relative{};  ///< >= 0, share of the reading
    double sigma_quadratic = 0;     ///< >= 0, 1 / unit of the reading
    double pointing = 0;            ///< rad, >= 0: standard deviation of the direction of a ray
    double correlation = 0;         ///< c, -1 .. 1
    PerComponent density{};         ///< N, >= 0, unit of the reading / sqrt(Hz)
  };
  static constexpr double max_incidence = 1.5;  ///< rad: rays at larger angles have no more noise

  WhiteNoise() = default;
  /// `period`: s, between samples; used only with a density.
  WhiteNoise(const Settings& settings, double period) : settings_(settings) {
    constant_ = settings.sigma.with(
        settings.density, [&](double sigma, double n) { return sigma * sigma + (n == 0 ? 0 : n * n / period); });
    innovation_ = std::sqrt(1 - settings.correlation * settings.correlation);
    is_active_ = !settings.sigma_relative.is_zero() || settings.pointing > 0 || settings.sigma_quadratic > 0 ||
                 !constant_.is_zero();
  }

  /// Adds bias and noise. `bias(i)`: bias of component i. Values with `untouched(i)` do not change. `incidence`: rad,
  /// of each value, or empty.
  template <class Bias, class Untouched>
  void apply(std::span<double> values, const Random& random, std::span<const double> incidence, Bias bias,
             Untouched untouched) const {
    NormalNumbers numbers(random, values.size());
    double n = 0;
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      if (is_active_) {
        const double e = numbers.next();
        n = i == 0 ? e : settings_.correlation * n + innovation_ * e;
      }
      if (untouched(i)) continue;
      const double relative_pointing =
          incidence.empty() ? 0 : settings_.pointing * elementary::tan(std::min(incidence[i], max_incidence));
      const double y = values[i], relative = settings_.sigma_relative[i];
      const double quadratic = settings_.sigma_quadratic * y * y;
      const double variance =
          constant_[i] + (relative * relative + relative_pointing * relative_pointing) * y * y + quadratic * quadratic;
      values[i] = y + (bias(i) + n * std::sqrt(variance));
    }
  }

 private:
  Settings settings_;
  PerComponent constant_;  ///< variance that does not depend on the reading
  double innovation_ = 1;
  bool is_active_ = false;
};

}  // namespace muro
