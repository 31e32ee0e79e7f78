// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstring>
#include <deque>
#include <string>

#include "error_chain.hpp"
#include "muro/connector.hpp"

namespace muro {

/// A key that owns its texts. Properties keep pointers to them.
template <class T>
struct OwnedKey {
  std::string name, unit;
  Key<T> key;
  OwnedKey(std::string name_, std::string unit_, std::string_view doc)
      : name(std::move(name_)), unit(std::move(unit_)), key(name, unit, doc) {}
  OwnedKey(const OwnedKey&) = delete;
  OwnedKey& operator=(const OwnedKey&) = delete;
};

/// The properties that sensor.error adds to a reading of type T: the reading of the device, and its errors as constants
/// of type E, so that readings and errors can be compared.
template <class T, class E = T>
class Published {
 public:
  using Reading = T;
  /// Returns the key of the reading of the device.
  const Key<T>& measured(const KeyInfo& of) {
    return key(measured_, std::string(of.name) + ".measured", std::string(of.unit), "as the device reports it");
  }

  /// Sets the constants `of`.error.* that are not 0.
  void set_constants(Connector& c, ObjectId object, const KeyInfo& of, const ErrorSettings& s, double period) {
    const std::string unit(*of.type == value_type<Quat> ? "rad" : *of.type == value_type<Pose> ? "m, rad" : of.unit);
    const auto density = [&](std::size_t i) {
      return elementary::hypot(s.noise.density[i], s.noise.sigma[i] * std::sqrt(period));
    };
    set(c, object, of, "noise_density", unit + " by sqrt(Hz)", "of white noise", density);
    const auto set_each = [&](const char* name, const std::string& in, const char* doc, const PerComponent& value) {
      set(c, object, of, name, in, doc, [&](std::size_t i) { return value[i]; });
    };
    set_each("bias_instability", unit, "of flicker noise", s.drift.bias_instability);
    set_each("random_walk", unit + " by s sqrt(Hz)", "density of the bias that walks", s.drift.random_walk);
    set_each("gauss_markov_sigma", unit, "standard deviation of the bias that drifts", s.drift.gauss_markov_sigma);
    set_each("resolution", unit, "least difference of two readings", s.quantiser.step());
    const bool drifts = !s.drift.gauss_markov_sigma.is_zero(), flickers = !s.drift.bias_instability.is_zero();
    set_each("gauss_markov_time", "s", "correlation time of the bias that drifts",
             drifts ? s.drift.gauss_markov_time : 0);
    set_each("flicker_from", "s", "from where flicker is flat", flickers ? s.drift.flicker_from : 0);
    set_each("flicker_to", "s", "up to where flicker is flat", flickers ? s.drift.flicker_to : 0);
  }

 private:
  template <class Values>
  void set(Connector& c, ObjectId object, const KeyInfo& of, const char* name, const std::string& unit, const char* doc,
           Values values) {
    std::array<double, value_type<E>.scalars()> numbers{};
    bool any = false;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = values(i);
      any = any || numbers[i] != 0;
    }
    if (!any) return;
    E value{};
    std::memcpy(static_cast<void*>(&value), numbers.data(), sizeof value);
    c.set(object, key(figures_, std::string(of.name) + ".error." + name, unit, doc), value);
  }
  template <class V>
  static const Key<V>& key(std::deque<OwnedKey<V>>& keys, const std::string& name, const std::string& unit,
                           std::string_view doc) {
    for (const OwnedKey<V>& k : keys)
      if (k.name == name && k.unit == unit) return k.key;
    return keys.emplace_back(name, unit, doc).key;
  }
  std::deque<OwnedKey<T>> measured_;
  std::deque<OwnedKey<E>> figures_;
};

}  // namespace muro
