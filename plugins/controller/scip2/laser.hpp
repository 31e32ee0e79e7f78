// SPDX-License-Identifier: MIT
#pragma once

#include "muro/connector.hpp"
#include "readings.hpp"

namespace muro::scip2 {

/// The simulated laser of a device.
class Laser {
 public:
  /// Returns the object that a controller is `on` if it is a laser, else the only laser of its robot. Throws
  /// muro::Error. Called after sensors have connected. [setup]
  static ObjectId find(const Connector& connector, const Item& item);

  /// Binds the laser's reading: `ranges.measured`, which a sensor.error makes, else the true ranges. Throws muro::Error
  /// when the device cannot use the laser; warns when steps have no ray. [by name]
  void bind(Connector& connector, ObjectId laser, const Model& model);
  /// Whether the rays are measured one after the other.
  static bool is_swept(const Connector& connector, ObjectId laser);

  void read(const Readings& readings, std::span<std::uint32_t> distances, std::span<std::uint32_t> intensities) const;
  const RayGrid& grid() const { return grid_; }

 private:
  void read_grid(Connector& connector, ObjectId laser, const std::string& name);

  ArrayIn<double> truth_, measured_, incidence_;
  RayGrid grid_;
  double max_range_ = 0;
};

}  // namespace muro::scip2
