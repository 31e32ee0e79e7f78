// SPDX-License-Identifier: MIT
#include "geodetic.hpp"

#include <gtest/gtest.h>

namespace muro::geodetic {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Compares with GeographicLib: `echo 33.3 44.4 6000 | CartConvert`.
TEST(Geodetic, PlacesAreWhereGeographicLibPutsThem) {
  const Vec3 seen = wgs84::to_earth({33.3 * degree, 44.4 * degree, 6000});
  EXPECT_LT((seen - Vec3(3816209.60, 3737108.55, 3485109.57)).norm(), 0.01);
}

TEST(Geodetic, TheWayBackLeadsToTheSamePlace) {
  for (const double latitude : {-89.9999, -60.0, -1e-9, 0.0, 12.3, 45.0, 77.7, 89.9999})
    for (const double longitude : {-179.9, -90.0, 0.0, 33.0, 180.0})
      for (const double altitude : {-5000.0, 0.0, 9000.0, 400e3}) {
        const GeodeticPlace p{latitude * degree, longitude * degree, altitude};
        const GeodeticPlace back = wgs84::from_earth(wgs84::to_earth(p));
        EXPECT_NEAR(back.latitude, p.latitude, 2e-12);
        EXPECT_NEAR(back.longitude, p.longitude, 2e-12);
        EXPECT_NEAR(back.altitude, p.altitude, 2e-8);
      }
}

TEST(Geodetic, APoleHasAnAltitude) {
  const GeodeticPlace pole = wgs84::from_earth({0, 0, -wgs84::b - 10});
  EXPECT_DOUBLE_EQ(pole.latitude, -90 * degree);
  EXPECT_NEAR(pole.altitude, 10, 1e-8);
}

}  // namespace
}  // namespace muro::geodetic
