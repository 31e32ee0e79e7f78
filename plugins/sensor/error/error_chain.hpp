// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>

#include "alignment.hpp"
#include "bias_drift.hpp"
#include "delay_line.hpp"
#include "dropouts.hpp"
#include "low_pass.hpp"
#include "quantiser.hpp"
#include "white_noise.hpp"

namespace muro {

/// The errors of one reading of a device; without any, it reads the truth.
struct ErrorSettings {
  PerComponent bandwidth{};  ///< Hz; 0: none
  int bandwidth_order = 1;   ///< 1 or 2
  Alignment::Settings alignment{};
  PerComponent bias{};                    ///< unit of the reading
  PerComponent turn_on_bias_tolerance{};  ///< of three standard deviations, unit of the reading
  BiasDrift::Settings drift{};
  WhiteNoise::Settings noise{};
  Quantiser quantiser{};
  double delay = 0;  ///< s
  Dropouts::Settings dropouts{};
  /// Readings from here on mean that no echo came back: only what follows the noise is done to them.
  double no_echo_from = std::numeric_limits<double>::infinity();
};

/// From the true reading to the device's, sample by sample: bandwidth, scale with misalignment and g-sensitivity, bias
/// with its drift and noise, saturation with resolution and limits, delay, dropouts.
class ErrorChain {
 public:
  /// What belongs to one sample.
  struct Sample {
    std::uint64_t seed = 0;                ///< of the run
    std::uint64_t index = 0;               ///< of the sample
    std::span<const double> incidence{};   ///< rad, of each ray, or empty
    const Vec3* specific_force = nullptr;  ///< m/s^2, for g-sensitivity, or null
  };

  /// `period`: s, between samples, or 0 where it is not known: then what depends on time throws muro::Error. `key`: of
  /// the random numbers of this reading.
  ErrorChain(const ErrorSettings& settings, std::size_t components, double period, std::uint64_t key);

  /// Numbers of state, which begin as zeros.
  std::size_t state_size() const { return layout_.size(); }
  bool feels_force() const { return alignment_.feels_force(); }

  /// `truth` and `measured` have one number for each component and do not overlap; `state` has state_size() numbers.
  void apply(std::span<const double> truth, std::span<double> measured, std::span<double> state,
             const Sample& sample) const;

 private:
  void begin(std::span<double> state, std::uint64_t seed) const;

  StateLayout layout_;
  std::size_t components_ = 0;
  std::uint64_t key_ = 0;
  std::size_t begun_ = 0, turn_on_bias_ = 0;  ///< places in the state
  bool has_turn_on_bias_ = false;
  PerComponent bias_, turn_on_bias_tolerance_;
  Quantiser quantiser_;
  double no_echo_from_ = 0;
  LowPass low_pass_;
  Alignment alignment_;
  BiasDrift drift_;
  WhiteNoise noise_;
  DelayLine delay_;
  Dropouts dropouts_;
};

}  // namespace muro
