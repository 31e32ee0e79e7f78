// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "muro/base/elementary.hpp"
#include "per_component.hpp"

namespace muro {

/// The bandwidth of a device: a low-pass of first order, H = w / (s + w), or of second order by Butterworth,
/// H = w^2 / (s^2 + sqrt(2) w s + w^2), with w = 2 pi times the bandwidth, at which both pass 1/sqrt(2) of the
/// amplitude.
///
/// Between two samples the input is assumed to be linear (first-order hold, ramp-invariant). For such an input the
/// discretisation is exact at any period. For the slope m the output follows the particular solution u - m / w, or
/// u - sqrt(2) m / w with the rate m. Its deviation from this solution decays by the free response over one period
/// (Franklin, Powell, Workman: Digital Control of Dynamic Systems, section 6.3). It begins at rest at the first input.
class LowPass {
 public:
  LowPass() = default;
  /// `bandwidth`: Hz, 0: none. `order`: 1 or 2. `period`: s, between samples.
  LowPass(const PerComponent& bandwidth, int order, std::size_t components, double period, StateLayout& layout)
      : order_(order) {
    if (bandwidth.is_zero()) return;
    for (std::size_t i = 0; i < components; ++i) filters_.push_back(design(bandwidth[i], order, period));
    state_ = layout.reserve(3 * components);
  }

  bool is_active() const { return !filters_.empty(); }

  /// Replaces the samples by the filtered ones. `first`: there was no earlier sample.
  void apply(std::span<double> values, std::span<double> state, bool first) const {
    for (std::size_t i = 0; i < filters_.size(); ++i) {
      if (filters_[i].angular_bandwidth == 0) continue;
      double* s = &state[state_ + 3 * i];  // the last input, the output, its rate
      if (first) {
        s[0] = s[1] = values[i];
        s[2] = 0;
      }
      values[i] = order_ == 1 ? first_order(filters_[i], s, values[i]) : second_order(filters_[i], s, values[i]);
    }
  }

 private:
  /// The free response over one period.
  struct Filter {
    double angular_bandwidth = 0;  ///< rad/s
    double period = 0;             ///< s
    double decay = 0;              ///< factor of the deviation, first order
    /// Second order: new deviation and rate from the old deviation and rate.
    double from_deviation[2] = {0, 0}, from_rate[2] = {0, 0};
  };

  static Filter design(double bandwidth, int order, double period) {
    Filter f{.angular_bandwidth = 2 * M_PI * bandwidth, .period = period};
    const double w = f.angular_bandwidth;
    if (order == 1) {
      f.decay = elementary::exp(-w * period);
      return f;
    }
    const double a = w * M_SQRT1_2;  // damping and frequency of the free oscillation
    if (w == 0) return f;
    const auto [sine, cosine] = elementary::sincos(a * period);
    const double e = elementary::exp(-a * period);
    f.from_deviation[0] = e * (cosine + sine);
    f.from_rate[0] = e * sine / a;
    f.from_deviation[1] = -e * w * w / a * sine;
    f.from_rate[1] = e * (cosine - sine);
    return f;
  }

  static double first_order(const Filter& f, double* s, double input) {
    const double lag = (input - s[0]) / (f.period * f.angular_bandwidth);  // lag behind a ramp of this slope
    s[1] = input - lag + f.decay * (s[1] - (s[0] - lag));
    s[0] = input;
    return s[1];
  }

  static double second_order(const Filter& f, double* s, double input) {
    const double slope = (input - s[0]) / f.period, lag = M_SQRT2 * slope / f.angular_bandwidth;
    const double deviation = s[1] - (s[0] - lag), rate = s[2] - slope;
    s[1] = input - lag + f.from_deviation[0] * deviation + f.from_rate[0] * rate;
    s[2] = slope + f.from_deviation[1] * deviation + f.from_rate[1] * rate;
    s[0] = input;
    return s[1];
  }

  int order_ = 1;
  std::vector<Filter> filters_;  ///< one for each component
  std::size_t state_ = 0;
};

}  // namespace muro
