// SPDX-License-Identifier: MIT
#pragma once

#include "muro/connector.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/sensor/common/geodetic/geodetic.hpp"
#include "plugins/sensor/common/geodetic/keys.hpp"
#include "published.hpp"

namespace muro {

/// The latitude, longitude and altitude that a receiver of satellite navigation reads: the place of its
/// `gps.position.measured`, so that both have the same errors.
class MeasuredPlace {
 public:
  MeasuredPlace() = default;
  /// [setup]
  MeasuredPlace(Connector& c, ObjectId object, Published<double>& published, const Vec3& reference)
      : plane_(geodetic::LocalPlane::at(reference)),
        latitude_(c.variable(object, published.measured(keys::latitude), 0.0)),
        longitude_(c.variable(object, published.measured(keys::longitude), 0.0)),
        altitude_(c.variable(object, published.measured(keys::altitude), 0.0)) {}

  explicit operator bool() const { return bool(latitude_); }

  /// `position`: m, east, north and up of the reference.
  void write(const Vec3& position) const {
    const geodetic::GeodeticPlace place = plane_.place_of(position);
    *latitude_ = place.latitude / geodetic::radians_by_degree;
    *longitude_ = place.longitude / geodetic::radians_by_degree;
    *altitude_ = place.altitude;
  }

 private:
  geodetic::LocalPlane plane_;
  Out<double> latitude_, longitude_, altitude_;
};

}  // namespace muro
