// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "muro/base/elementary.hpp"
#include "muro/base/random.hpp"
#include "muro/toolkit/flicker_noise.hpp"
#include "per_component.hpp"

namespace muro {

/// A bias that changes: b_(k+1) = phi b_k + u e_k, e_k independent standard normal numbers. Each process is discretised
/// exactly, so that its statistics do not depend on the period h of the samples:
///
///     random walk of density K           phi = 1,            u = K sqrt(h),             b_0 = 0
///     Gauss-Markov, deviation s, time T  phi = exp(-h / T),  u = s sqrt(1 - phi^2),     b_0 normal, deviation s
///     the same by driving density K      s = K sqrt(T / 2)
///     flicker of bias instability B      the sum of Gauss-Markov processes of toolkit/flicker_noise.hpp
class BiasDrift {
 public:
  struct Settings {
    PerComponent random_walk{};                  ///< K, unit of the reading / (s sqrt(Hz))
    PerComponent gauss_markov_sigma{};           ///< s, stationary standard deviation, unit of the reading
    double gauss_markov_time = 0;                ///< T, s
    PerComponent bias_instability{};             ///< B, unit of the reading
    double flicker_from = 1, flicker_to = 1000;  ///< s: range in which the Allan deviation of flicker is flat
  };

  BiasDrift() = default;
  /// `period`: s, between samples.
  BiasDrift(const Settings& settings, std::size_t components, double period, std::uint64_t key, StateLayout& layout)
      : components_(components) {
    if (!settings.random_walk.is_zero())
      add({{1, std::sqrt(period), 0}}, settings.random_walk, fnv1a("random walk", key), layout);
    if (!settings.gauss_markov_sigma.is_zero())
      add({gauss_markov(1, settings.gauss_markov_time, period)}, settings.gauss_markov_sigma,
          fnv1a("Gauss-Markov", key), layout);
    if (!settings.bias_instability.is_zero()) {
      std::vector<Process> processes;
      for (const FlickerProcess& p : flicker_processes(settings.flicker_from, settings.flicker_to))
        processes.push_back(gauss_markov(p.sigma, p.time, period));
      add(std::move(processes), settings.bias_instability, fnv1a("flicker", key), layout);
    }
  }

  bool is_active() const { return !families_.empty(); }

  /// Draws the states of all processes at the start of a run.
  void begin(std::span<double> state, std::uint64_t seed) const {
    for (const Family& f : families_) {
      const Random random(seed, fnv1a("at the start", f.key), 0);
      each(f, state, random, [](const Process& p, double, double e) { return p.start * e; });
    }
  }

  /// Advances the processes from one sample to the next.
  void advance(std::span<double> state, std::uint64_t seed, std::uint64_t step) const {
    for (const Family& f : families_) {
      const Random random(seed, f.key, step);
      each(f, state, random, [](const Process& p, double b, double e) { return p.decay * b + p.innovation * e; });
    }
  }

  /// Returns the present bias of a component.
  double at(std::size_t component, std::span<const double> state) const {
    double sum = 0;
    for (const Family& f : families_) {
      double b = 0;
      for (std::size_t k = 0; k < f.processes.size(); ++k) b += state[f.state + k * components_ + component];
      sum += f.amplitude[component] * b;
    }
    return sum;
  }

 private:
  /// A process with the amplitude 1.
  struct Process {
    double decay, innovation, start;
  };
  /// Processes of equal amplitude.
  struct Family {
    std::vector<Process> processes;
    PerComponent amplitude;
    std::uint64_t key;
    std::size_t state;
  };

  static Process gauss_markov(double sigma, double time, double period) {
    return {elementary::exp(-period / time), sigma * std::sqrt(-elementary::expm1(-2 * period / time)), sigma};
  }
  void add(std::vector<Process> processes, const PerComponent& amplitude, std::uint64_t key, StateLayout& layout) {
    const std::size_t count = processes.size() * components_;
    families_.push_back({std::move(processes), amplitude, key, layout.reserve(count)});
  }
  template <class Next>
  void each(const Family& f, std::span<double> state, const Random& random, Next next) const {
    NormalNumbers numbers(random, f.processes.size() * components_);
    double* b = &state[f.state];
    for (const Process& p : f.processes)
      for (std::size_t i = 0; i < components_; ++i, ++b) *b = next(p, *b, numbers.next());
  }

  std::size_t components_ = 0;
  std::vector<Family> families_;
};

}  // namespace muro
