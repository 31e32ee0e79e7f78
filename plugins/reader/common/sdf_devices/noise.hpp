// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "fields.hpp"
#include "subsystem.hpp"

namespace muro::sdf_devices {

/// <noise> of SDFormat: Gaussian noise of a sample, a bias drawn once a run, a bias that drifts, steps of a converter.
struct Noise {
  double mean = 0, sigma = 0;            ///< as read
  double bias_mean = 0, bias_sigma = 0;  ///< as read
  double drift_density = 0;              ///< of a Gauss-Markov bias, as read by s sqrt(Hz)
  double drift_time = 0;                 ///< s
  double precision = 0;                  ///< as read; 0: none
  bool is_there() const;
};

/// From <mean>, <stddev>, <bias_mean> and <bias_stddev> of an element.
Noise gaussian_noise(Fields& fields);

/// That of a child <noise>, or none. `default_type`: where it states none.
Noise take_noise(Fields& fields, std::string_view default_type = "none");

/// The errors of one reading, of each of its components, as a `sensor.error` on the sensor. `property`: what it
/// changes. Nothing where no component has any.
std::vector<Subsystem> error_of(const Subsystem& sensor, std::string_view suffix, std::string_view property,
                                const std::vector<Noise>& components);

}  // namespace muro::sdf_devices
