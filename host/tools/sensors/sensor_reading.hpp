// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "host/tools/sensors/allan_deviation.hpp"

namespace muro::host {

/// A reading that a device of a built simulation takes repeatedly.
struct SensorReading {
  std::string sensor;                 ///< the object: "rover/imu"
  std::string property;               ///< "angular_velocity.measured"
  std::string unit;                   ///< unit of the property
  std::vector<std::string> labels;    ///< of its components: "x", "y", "z", or one empty label
  std::vector<NoiseFigures> figures;  ///< of its components, as in sensor.error
  const double* values = nullptr;     ///< the present values of the components
  Rate rate;                          ///< rate of the algorithm that writes it
  std::int64_t phase = 0;             ///< ns

  /// Time (ns) just after sample number k has been written.
  std::int64_t time_after(std::uint64_t k) const { return phase + rate.time_of(k) + 1; }
};

/// Returns the readings of the sensor, an object "robot/sensor", or "sensor" when only one robot has it. They are those
/// that a sensor.error has changed: all readings, or the one named `reading`, which may also be one without errors.
/// Throws SetupError with the existing names when there is no such sensor or reading.
std::vector<SensorReading> find_readings(const Simulation& simulation, const std::string& sensor,
                                         const std::string& reading);

}  // namespace muro::host
