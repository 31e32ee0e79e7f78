// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/tools/sensors/sensor_reading.hpp"

namespace muro::host {

/// A reading, and the Allan deviations of its components.
struct AllanCurves {
  SensorReading reading;
  std::size_t samples = 0;                      ///< for each component
  std::vector<std::vector<AllanPoint>> points;  ///< for each component
};

/// Computes the curves from the samples of each component.
AllanCurves allan_curves(SensorReading reading, const std::vector<std::vector<double>>& samples);

/// Returns a table: averaging time, the deviations of the components, and their expected values from the figures of the
/// part, with a band of two standard deviations of the estimate.
std::string allan_table(const AllanCurves& curves);
/// Returns an SVG file: the deviations, the lines of white noise, flicker and random walk, and the band.
std::string allan_picture(const AllanCurves& curves, const std::string& scenario);

}  // namespace muro::host
