// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/simulation.hpp"
#include "host/tools/sensors/allan_deviation.hpp"

namespace muro::host {

/// What a device of a built simulation reads, again and again.
struct SensorReading {
  std::string sensor;                 ///< the object: "rover/imu"
  std::string property;               ///< "angular_velocity.measured"
  std::string unit;                   ///< of the property
  std::vector<std::string> labels;    ///< of its components: "x", "y", "z", or one empty label
  std::vector<NoiseFigures> figures;  ///< of its components, as sensor.error states them
  const double* values = nullptr;     ///< the components now
  Rate rate;                          ///< of who writes it
  std::int64_t phase = 0;             ///< ns

  /// When sample number k has been written: just after it, ns.
  std::int64_t time_after(std::uint64_t k) const { return phase + rate.time_of(k) + 1; }
};

/// The readings of the sensor, an object "robot/sensor", or "sensor" where only one robot has it: what a sensor.error
/// has made of them, of all readings or of the one named `reading`, which may also be one without errors. Throws
/// SetupError, with what there is, where there is no such sensor or reading.
std::vector<SensorReading> find_readings(const Simulation& simulation, const std::string& sensor,
                                         const std::string& reading);

}  // namespace muro::host
