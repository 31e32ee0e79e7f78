// SPDX-License-Identifier: MIT
// Converts between places on the earth and a plane that touches it: WGS 84 (NIMA TR8350.2), east, north, up.
#pragma once

#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"
#include "muro/geometry.hpp"

namespace muro::geodetic {

struct GeodeticPlace {
  double latitude = 0, longitude = 0;  ///< rad
  double altitude = 0;                 ///< m above the ellipsoid
};

inline constexpr double radians_by_degree = std::numbers::pi / 180;

namespace wgs84 {

inline constexpr double a = 6378137;            ///< m, equatorial radius
inline constexpr double f = 1 / 298.257223563;  ///< flattening
inline constexpr double e2 = f * (2 - f);       ///< square of the first eccentricity
inline constexpr double b = a * (1 - f);        ///< m, polar radius
inline constexpr double second_e2 = e2 / (1 - e2);

/// Returns the position in the frame of the earth: m from its centre, x to (0, 0), z to the north pole.
inline Vec3 to_earth(const GeodeticPlace& place) {
  const auto [sin_lat, cos_lat] = elementary::sincos(place.latitude);
  const auto [sin_lon, cos_lon] = elementary::sincos(place.longitude);
  const double n = a / std::sqrt(1 - e2 * sin_lat * sin_lat);
  return {(n + place.altitude) * cos_lat * cos_lon, (n + place.altitude) * cos_lat * sin_lon,
          (n * (1 - e2) + place.altitude) * sin_lat};
}

/// Returns the place of a position in the frame of the earth. Applies Bowring's formula (Survey Review 23, 1976) three
/// times: errors are below 1e-12 rad and 1e-8 m up to about 1000 km from the surface.
inline GeodeticPlace from_earth(const Vec3& p) {
  const double across = std::sqrt(p.x() * p.x() + p.y() * p.y());
  double tan_u = across > 0 ? p.z() / across * (a / b) : 0;
  GeodeticPlace place;
  if (across < 1e-6) {  // at a pole
    place.latitude = std::copysign(0.5 * std::numbers::pi, p.z());
    place.altitude = std::abs(p.z()) - b;
    return place;
  }
  double tan_lat = 0;
  for (int i = 0; i < 3; ++i) {
    const double cos_u = 1 / std::sqrt(1 + tan_u * tan_u), sin_u = tan_u * cos_u;
    tan_lat = (p.z() + second_e2 * b * sin_u * sin_u * sin_u) / (across - e2 * a * cos_u * cos_u * cos_u);
    tan_u = (1 - f) * tan_lat;
  }
  const double cos_lat = 1 / std::sqrt(1 + tan_lat * tan_lat), sin_lat = tan_lat * cos_lat;
  const double n = a / std::sqrt(1 - e2 * sin_lat * sin_lat);
  place.latitude = elementary::atan(tan_lat);
  place.longitude = elementary::atan2(p.y(), p.x());
  place.altitude = across * cos_lat + (p.z() + e2 * n * sin_lat) * sin_lat - n;
  return place;
}

}  // namespace wgs84

/// The horizontal plane through a reference: it touches there the surface that is parallel to the ellipsoid.
class LocalPlane {
 public:
  LocalPlane() = default;
  /// `reference`: latitude and longitude (deg), altitude (m).
  static LocalPlane at(const Vec3& reference) {
    return LocalPlane({reference.x() * radians_by_degree, reference.y() * radians_by_degree, reference.z()});
  }
  explicit LocalPlane(const GeodeticPlace& reference) : origin_(wgs84::to_earth(reference)) {
    const auto [sin_lat, cos_lat] = elementary::sincos(reference.latitude);
    const auto [sin_lon, cos_lon] = elementary::sincos(reference.longitude);
    axes_ << -sin_lon, -sin_lat * cos_lon, cos_lat * cos_lon,  //
        cos_lon, -sin_lat * sin_lon, cos_lat * sin_lon,        //
        0, cos_lat, sin_lat;
  }

  /// Returns the place of a point that is given in m east, north and up of the reference.
  GeodeticPlace place_of(const Vec3& east_north_up) const { return wgs84::from_earth(origin_ + axes_ * east_north_up); }

 private:
  Vec3 origin_ = Vec3::Zero();
  Mat3 axes_ = Mat3::Identity();  ///< columns: east, north, up in the frame of the earth
};

}  // namespace muro::geodetic
