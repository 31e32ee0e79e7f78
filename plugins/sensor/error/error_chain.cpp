// SPDX-License-Identifier: MIT
#include "error_chain.hpp"

#include <string>

#include "muro/algorithm.hpp"

namespace muro {

namespace {

/// Throws where an error of this kind needs the time between samples.
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

ErrorChain::ErrorChain(const ErrorSettings& s, std::size_t components, double period, std::uint64_t key)
    : components_(components),
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
  delay_ = DelayLine(s.delay, components, period, layout);
  dropouts_ = Dropouts(s.dropouts, components, layout);
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

void ErrorChain::apply(std::span<const double> truth, std::span<double> measured, std::span<double> state,
                       const Sample& sample) const {
  const bool first = !state.empty() && state[begun_] == 0;
  if (first) begin(state, sample.seed);
  std::copy(truth.begin(), truth.end(), measured.begin());
  if (low_pass_.is_active()) low_pass_.apply(measured, state, first);
  if (alignment_.is_active()) alignment_.apply(measured, state, sample.specific_force);
  if (drift_.is_active() && !first) drift_.advance(state, sample.seed, sample.index);
  const Random random(sample.seed, key_, sample.index);
  noise_.apply(
      measured, random, sample.incidence,
      [&](std::size_t i) {
        double b = bias_[i];
        if (has_turn_on_bias_) b += state[turn_on_bias_ + i];
        return drift_.is_active() ? b + drift_.at(i, state) : b;
      },
      [&](std::size_t i) { return truth[i] >= no_echo_from_; });
  for (std::size_t i = 0; i < measured.size(); ++i)
    measured[i] = quantiser_(truth[i] >= no_echo_from_ ? truth[i] : measured[i]);
  if (delay_.is_active()) delay_.apply(measured, state, first);
  dropouts_.apply(measured, state, random, first);
}

}  // namespace muro
