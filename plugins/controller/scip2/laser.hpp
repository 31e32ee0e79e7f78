// SPDX-License-Identifier: MIT
#pragma once

#include "muro/connector.hpp"
#include "readings.hpp"

namespace muro::scip2 {

/// The simulated laser behind a device.
class Laser {
 public:
  /// The object that a controller is `on` when that is a laser, else the only laser of its robot. Throws muro::Error.
  /// Once sensors have connected. [setup]
  static ObjectId find(const Connector& connector, const Item& item);

  /// Binds what the laser reports: the reading of the device (`ranges.measured`) where there is a sensor.error, else
  /// the true one. Throws muro::Error when the device cannot work with it; warns where steps have no ray. [by name]
  void bind(Connector& connector, ObjectId laser, const Model& model);
  /// Whether rays are taken one after the other.
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
