// SPDX-License-Identifier: MIT
#include "error_chain.hpp"

#include <string>

#include "muro/algorithm.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro {

namespace {

/// Throws muro::Error if settings need the time between samples, but `period` is 0.
void require_period(const ErrorSettings& s, double period) {
  if (period > 0) return;
  const char* needs = nullptr;
  if (!s.bandwidth.is_zero()) needs = "bandwidth";
  if (!s.drift.random_walk.is_zero()) needs = "random_walk";
  if (!s.drift.gauss_markov_sigma.is_zero()) needs = "gauss_markov_sigma";
  if (!s.drift.bias_instability.is_zero()) needs = "bias_instability";
  if (!s.noise.density.is_zero()) needs = "noise_density";
  if (s.delay > 0) needs = "delay";
  if (needs)
    throw Error(std::string(needs) + " depends on the time between readings, which is not known on demand; give the " +
                "sensor.error the `rate` of its sensor");
}

}  // namespace

ErrorChain::ErrorChain(const ErrorSettings& s, std::size_t components, double period, std::uint64_t key, Form form)
    : form_(form),
      components_(components),
      key_(key),
      bias_(s.bias),
      turn_on_bias_tolerance_(s.turn_on_bias_tolerance),
      quantiser_(s.quantiser),
      no_echo_from_(s.no_echo_from) {
  require_period(s, period);
  StateLayout layout;
  begun_ = layout.reserve(1);
  has_turn_on_bias_ = !s.turn_on_bias_tolerance.is_zero();
  if (has_turn_on_bias_) turn_on_bias_ = layout.reserve(components);
  low_pass_ = LowPass(s.bandwidth, s.bandwidth_order, components, period, layout);
  alignment_ = Alignment(s.alignment, components, key, layout);
  drift_ = BiasDrift(s.drift, components, period, key, layout);
  noise_ = WhiteNoise(s.noise, period);
  const std::size_t numbers = form == Form::numbers ? components : components + 1;
  delay_ = DelayLine(s.delay, numbers, period, layout);
  dropouts_ = Dropouts(s.dropouts, numbers, layout);
  if (layout.size() > 1) layout_ = layout;  // a chain without memory has no state
}

void ErrorChain::begin(std::span<double> state, std::uint64_t seed) const {
  state[begun_] = 1;
  alignment_.begin(state, seed);
  drift_.begin(state, seed);
  if (!has_turn_on_bias_) return;
  const Random random(seed, fnv1a("turn-on bias", key_), 0);
  for (std::size_t i = 0; i < components_; ++i)
    state[turn_on_bias_ + i] = turn_on_bias_tolerance_[i] / tolerance_in_deviations * random.normal(std::uint32_t(i));
}

bool ErrorChain::next_sample(std::span<double> state, const Sample& sample) const {
  const bool first = !state.empty() && state[begun_] == 0;
  if (first) begin(state, sample.seed);
  if (drift_.is_active() && !first) drift_.advance(state, sample.seed, sample.index);
  return first;
}

void ErrorChain::run_stages(std::span<const double> truth, std::span<double> values, std::span<const double> state,
                            const Sample& sample, const Random& random) const {
  if (alignment_.is_active()) alignment_.apply(values, state, sample.specific_force);
  const auto no_echo = [&](std::size_t i) { return truth[i] >= no_echo_from_; };
  noise_.apply(
      values, random, sample.incidence,
      [&](std::size_t i) {
        double b = bias_[i];
        if (has_turn_on_bias_) b += state[turn_on_bias_ + i];
        return drift_.is_active() ? b + drift_.at(i, state) : b;
      },
      no_echo);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = quantiser_(no_echo(i) ? truth[i] : values[i], i);
}

void ErrorChain::apply(std::span<const double> truth, std::span<double> measured, std::span<double> state,
                       const Sample& sample) const {
  const bool first = next_sample(state, sample);
  const Random random(sample.seed, key_, sample.index);
  std::copy(truth.begin(), truth.end(), measured.begin());
  if (form_ == Form::numbers) {
    if (low_pass_.is_active()) low_pass_.apply(measured, state, first);
    run_stages(truth, measured, state, sample, random);
  } else {
    double* const r = &measured[components_ - 3];
    const Quat q(r[3], r[0], r[1], r[2]);
    std::fill_n(r, 3, 0.0);
    run_stages(truth, measured.first(components_), state, sample, random);
    const Quat seen = rotation_of(Vec3(r[0], r[1], r[2])) * q;
    std::copy_n(seen.coeffs().data(), 4, r);
  }
  if (delay_.is_active()) delay_.apply(measured, state, first);
  dropouts_.apply(measured, state, random, first);
}

bool ErrorChain::apply_to_one(std::span<double> values, std::span<const double> state, const Sample& sample,
                              std::uint64_t key) const {
  const Random random(sample.seed, fnv1a({reinterpret_cast<const char*>(&key), sizeof key}, key_), sample.index);
  if (dropouts_.loses(random)) return false;
  run_stages(values, values, state, sample, random);
  return true;
}

}  // namespace muro
