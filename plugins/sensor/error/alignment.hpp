// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "muro/base/random.hpp"
#include "muro/geometry.hpp"
#include "per_component.hpp"

namespace muro {

/// Number of standard deviations of a limit in a data sheet. Values of a run are drawn from a normal distribution.
inline constexpr double tolerance_in_deviations = 3;

/// Scale, misalignment and g-sensitivity: y = (I + S + M) x + G f, with S diagonal, M without diagonal and the specific
/// force f. S and M have a given part and a part that is drawn once a run. M and G are for vectors (Vec3) only.
class Alignment {
 public:
  struct Settings {
    PerComponent scale{}, scale_tolerance{};       ///< 1
    std::array<double, 6> misalignment{};          ///< 1: xy, xz, yx, yz, zx, zy
    std::array<double, 6> cross_axis_tolerance{};  ///< 1, in the same order
    Mat3 g_sensitivity = Mat3::Zero();             ///< unit of the reading / (m/s^2)
  };

  Alignment() = default;
  Alignment(const Settings& settings, std::size_t components, std::uint64_t key, StateLayout& layout)
      : settings_(settings), components_(components), key_(fnv1a("scale and misalignment", key)) {
    const auto any = [](const std::array<double, 6>& six) {
      return std::any_of(six.begin(), six.end(), [](double v) { return v != 0; });
    };
    turns_ = any(settings.misalignment) || any(settings.cross_axis_tolerance);
    scales_ = turns_ || !settings.scale.is_zero() || !settings.scale_tolerance.is_zero();
    feels_force_ = settings.g_sensitivity != Mat3::Zero();
    if (scales_) state_ = layout.reserve(components + 6);
  }

  bool is_active() const { return scales_ || feels_force_; }
  bool feels_force() const { return feels_force_; }

  /// Draws the values of the whole run.
  void begin(std::span<double> state, std::uint64_t seed) const {
    if (!scales_) return;
    const Random random(seed, key_, 0);
    for (std::size_t i = 0; i < components_; ++i)
      state[state_ + i] = settings_.scale[i] + drawn(random, i, settings_.scale_tolerance[i]);
    for (std::size_t k = 0; k < 6; ++k)
      state[state_ + components_ + k] =
          settings_.misalignment[k] + drawn(random, components_ + k, settings_.cross_axis_tolerance[k]);
  }

  /// `force`: specific force, m/s^2; null if there is none.
  void apply(std::span<double> values, std::span<const double> state, const Vec3* force) const {
    if (turns_) {
      turn(values, state);
    } else if (scales_) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= 1 + state[state_ + i];
    }
    if (!feels_force_ || !force) return;
    const Vec3 added = settings_.g_sensitivity * *force;
    for (int i = 0; i < 3; ++i) values[std::size_t(i)] += added[i];
  }

 private:
  static double drawn(const Random& random, std::size_t i, double tolerance) {
    return tolerance == 0 ? 0 : tolerance / tolerance_in_deviations * random.normal(std::uint32_t(i));
  }
  void turn(std::span<double> values, std::span<const double> state) const {
    const double* s = &state[state_];
    const double* m = s + 3;
    const double x = values[0], y = values[1], z = values[2];
    values[0] = (1 + s[0]) * x + m[0] * y + m[1] * z;
    values[1] = m[2] * x + (1 + s[1]) * y + m[3] * z;
    values[2] = m[4] * x + m[5] * y + (1 + s[2]) * z;
  }

  Settings settings_;
  std::size_t components_ = 0;
  std::uint64_t key_ = 0;
  bool scales_ = false, turns_ = false, feels_force_ = false;
  std::size_t state_ = 0;  ///< scale errors, then misalignments
};

}  // namespace muro
