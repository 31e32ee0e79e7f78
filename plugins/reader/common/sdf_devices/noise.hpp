// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "fields.hpp"
#include "subsystem.hpp"

namespace muro::sdf_devices {

/// <noise> of SDFormat: Gaussian noise of a sample, a bias drawn once a run, a bias that drifts, steps of a converter.
struct Noise {
  double mean = 0, sigma = 0;            ///< unit of the reading
  double bias_mean = 0, bias_sigma = 0;  ///< unit of the reading
  double drift_density = 0;              ///< density of a Gauss-Markov bias, unit of the reading / (s sqrt(Hz))
  double drift_time = 0;                 ///< s
  double precision = 0;                  ///< unit of the reading; 0: none
  bool is_there() const;
};

/// Reads <mean>, <stddev>, <bias_mean> and <bias_stddev> of an element.
Noise gaussian_noise(Fields& fields);

/// Reads the child <noise>. Returns no noise if there is none. `default_type`: its type if the file states none.
Noise take_noise(Fields& fields, std::string_view default_type = "none");

/// Returns the errors of one reading as a `sensor.error` on the sensor; nothing if no component has errors. `property`:
/// the reading that it changes. `components`: the noise of each component of the reading.
std::vector<Subsystem> error_of(const Subsystem& sensor, std::string_view suffix, std::string_view property,
                                const std::vector<Noise>& components);

}  // namespace muro::sdf_devices
