// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/base/random.hpp"
#include "per_component.hpp"

namespace muro {

/// Lost readings. Each is lost with the same probability, independently of the others. In an array, such as a scan,
/// every element is lost independently; the components of one value (Vec3, Twist, Wrench) are lost together, as one
/// message. A lost reading is `value`, or the last reading that was not lost.
class Dropouts {
 public:
  struct Settings {
    double probability = 0;  ///< 0 .. 1
    double value = 0;        ///< unit of the reading
    bool hold = false;       ///< keep the last reading
    bool together = false;   ///< lose all components at once
  };

  Dropouts() = default;
  Dropouts(const Settings& settings, std::size_t components, StateLayout& layout) : settings_(settings) {
    if (is_active() && settings.hold) state_ = layout.reserve(components);
  }

  bool is_active() const { return settings_.probability > 0; }
  /// Whether the whole reading is lost.
  bool loses(const Random& random) const { return is_active() && random.uniform(0) < settings_.probability; }

  void apply(std::span<double> values, std::span<double> state, const Random& random, bool first) const {
    if (!is_active()) return;
    const bool all_lost = settings_.together && loses(random);
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      const bool lost = settings_.together ? all_lost : random.uniform(i) < settings_.probability;
      if (!settings_.hold) {
        if (lost) values[i] = settings_.value;
        continue;
      }
      double& last = state[state_ + i];
      if (lost && !first)
        values[i] = last;
      else
        last = values[i];
    }
  }

 private:
  Settings settings_;
  std::size_t state_ = 0;
};

}  // namespace muro
