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

/// The errors of one reading of a device. Without errors it reads the truth.
struct ErrorSettings {
  PerComponent bandwidth{};  ///< Hz; 0: none
  int bandwidth_order = 1;   ///< 1 or 2
  Alignment::Settings alignment{};
  PerComponent bias{};                    ///< unit of the reading
  PerComponent turn_on_bias_tolerance{};  ///< three standard deviations, unit of the reading
  BiasDrift::Settings drift{};
  WhiteNoise::Settings noise{};
  Quantiser quantiser{};
  double delay = 0;  ///< s
  Dropouts::Settings dropouts{};
  /// Readings of at least this value mean that no echo came back: only the stages after the noise change them.
  double no_echo_from = std::numeric_limits<double>::infinity();
};

/// Computes the reading of a device from the true reading, sample by sample: bandwidth, scale with misalignment and
/// g-sensitivity, bias with its drift and noise, saturation with resolution and limits, delay, dropouts.
///
/// A reading consists of numbers, each a component. It may end in an orientation q, four numbers (x, y, z, w). Then the
/// last three components are a rotation vector r (rad) in the axes of the frame to which q refers. Its true value is 0,
/// and the device reads exp(r) q. Delay and dropouts act on the reading exp(r) q. So the errors of a pose are those of
/// geometry_msgs/PoseWithCovariance: x, y, z, and rotations about these fixed axes.
class ErrorChain {
 public:
  /// Whether a reading ends in an orientation.
  enum class Form : std::uint8_t { numbers, with_orientation };

  /// Inputs of one sample.
  struct Sample {
    std::uint64_t seed = 0;                ///< seed of the run
    std::uint64_t index = 0;               ///< index of the sample
    std::span<const double> incidence{};   ///< rad, of each ray, or empty
    const Vec3* specific_force = nullptr;  ///< m/s^2, for g-sensitivity, or null
  };

  /// `period`: s, between samples, or 0 if it is not known: then errors that depend on time throw muro::Error. `key`:
  /// of the random numbers of this reading.
  ErrorChain(const ErrorSettings& settings, std::size_t components, double period, std::uint64_t key,
             Form form = Form::numbers);

  /// Returns how many numbers the state has. They begin as zeros.
  std::size_t state_size() const { return layout_.size(); }
  bool feels_force() const { return alignment_.feels_force(); }

  /// `truth` and `measured` have one number for each component (one more with an orientation) and do not overlap;
  /// `state` has state_size() numbers.
  void apply(std::span<const double> truth, std::span<double> measured, std::span<double> state,
             const Sample& sample) const;

  /// Reads several objects of one kind at a time. Call begin_sample() once a sample, then apply_to_one() for each
  /// object. Scale, biases and drifts are common to all objects. Noise and dropouts are independent for each, with the
  /// random numbers of `key`. For chains without bandwidth and delay. Returns false if the object is lost.
  void begin_sample(std::span<double> state, const Sample& sample) const { next_sample(state, sample); }
  bool apply_to_one(std::span<double> values, std::span<const double> state, const Sample& sample,
                    std::uint64_t key) const;

 private:
  void begin(std::span<double> state, std::uint64_t seed) const;
  /// Returns whether the sample is the first.
  bool next_sample(std::span<double> state, const Sample& sample) const;
  /// Applies the stages from scale to limits to `values`, in place. `truth`: shows where no echo came back.
  void run_stages(std::span<const double> truth, std::span<double> values, std::span<const double> state,
                  const Sample& sample, const Random& random) const;

  Form form_ = Form::numbers;
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
