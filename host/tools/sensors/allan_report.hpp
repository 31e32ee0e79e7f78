// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/tools/sensors/sensor_reading.hpp"

namespace muro::host {

/// A reading, and the Allan deviations of its components.
struct AllanCurves {
  SensorReading reading;
  std::size_t samples = 0;                      ///< of each component
  std::vector<std::vector<AllanPoint>> points;  ///< of each component
};

/// The samples of each component become curves.
AllanCurves allan_curves(SensorReading reading, const std::vector<std::vector<double>>& samples);

/// A table: averaging time, the deviations of the components, and what is expected of them by the figures of the part
/// with the band of two standard deviations of the estimate.
std::string allan_table(const AllanCurves& curves);
/// An SVG file: the deviations, the lines of white noise, flicker and random walk, and the band.
std::string allan_picture(const AllanCurves& curves, const std::string& scenario);

}  // namespace muro::host
