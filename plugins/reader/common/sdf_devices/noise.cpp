// SPDX-License-Identifier: MIT
#include "noise.hpp"

#include <algorithm>

namespace muro::sdf_devices {

namespace {

constexpr double most = 3e8;  // sums of three such values stay within the limits of sensor.error

std::string_view type_attribute(const Element& e) {
  const char* const type = e.Attribute("type");
  return type ? type : "";
}

}  // namespace

bool Noise::is_there() const {
  return mean != 0 || sigma > 0 || bias_mean != 0 || bias_sigma > 0 || (drift_density > 0 && drift_time > 0) ||
         precision > 0;
}

Noise gaussian_noise(Fields& fields) {
  Noise noise;
  noise.mean = fields.number("mean", -most, most).value_or(0);
  noise.sigma = fields.number("stddev", 0, most).value_or(0);
  noise.bias_mean = fields.number("bias_mean", -most, most).value_or(0);
  noise.bias_sigma = fields.number("bias_stddev", 0, most).value_or(0);
  return noise;
}

Noise take_noise(Fields& fields, std::string_view default_type) {
  Noise noise;
  Element* const e = fields.section("noise");
  if (!e) return noise;
  Fields given(*e, fields.owner() + ", <noise>", fields.messages());
  std::string type = given.text("type");
  if (type.empty()) type = type_attribute(*e);
  if (type.empty()) type = default_type;
  if (type == "none") return noise;
  if (!type.starts_with("gaussian")) {
    fields.messages().left_out.add(Severity::warning, concat("<noise type=", quote(type), ">"),
                                   "noise is Gaussian, with a bias that may drift", fields.messages().at(*e));
    return noise;
  }
  noise = gaussian_noise(given);
  noise.drift_density = given.number("dynamic_bias_stddev", 0, most).value_or(0);
  noise.drift_time = given.number("dynamic_bias_correlation_time", 0, most).value_or(0);
  noise.precision = given.number("precision", 0, most).value_or(0);
  if (type != "gaussian_quantized") noise.precision = 0;
  given.list_unread("noise is Gaussian, with a bias that may drift");
  return noise;
}

std::vector<Subsystem> error_of(const Subsystem& sensor, std::string_view suffix, std::string_view property,
                                const std::vector<Noise>& components) {
  const auto is_there = [](const Noise& n) { return n.is_there(); };
  if (std::none_of(components.begin(), components.end(), is_there)) return {};
  Subsystem error(sensor.name() + std::string(suffix), "sensor.error", sensor.location());
  error.mount_on(sensor.name());
  error.add("of", property);
  const auto add = [&](std::string_view key, auto value_of) {
    std::vector<double> values;
    for (const Noise& n : components) values.push_back(value_of(n));
    if (std::all_of(values.begin(), values.end(), [](double v) { return v == 0; })) return;
    if (std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end())
      error.add(key, values.front());
    else
      error.add(key, values);
  };
  add("sigma", [](const Noise& n) { return n.sigma; });
  add("bias", [](const Noise& n) { return n.mean + n.bias_mean; });
  add("turn_on_bias_tolerance", [](const Noise& n) { return 3 * n.bias_sigma; });
  const auto time = std::find_if(components.begin(), components.end(),
                                 [](const Noise& n) { return n.drift_density > 0 && n.drift_time > 0; });
  if (time != components.end()) {
    add("gauss_markov_density", [](const Noise& n) { return n.drift_time > 0 ? n.drift_density : 0; });
    error.add("gauss_markov_time", time->drift_time);
  }
  add("resolution", [](const Noise& n) { return n.precision; });
  return {error};
}

}  // namespace muro::sdf_devices
