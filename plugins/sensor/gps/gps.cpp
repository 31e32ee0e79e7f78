// SPDX-License-Identifier: MIT
// A receiver of satellite navigation: place on the earth, and velocity.
#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/sensor/common/geodetic/geodetic.hpp"
#include "plugins/sensor/common/geodetic/keys.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;
using geodetic::GeodeticPlace, geodetic::LocalPlane, geodetic::radians_by_degree;

constexpr double no_reference[] = {0, 0, 0};
constexpr Parameter parameters[] = {
    mounting_offset,
    reals("reference", "deg, deg, m", no_reference, "latitude, longitude and altitude of the world's origin")
        .of_length(3),
    real("heading", "rad", 0, "of the world's x axis, from east, counter-clockwise").between(-7, 7),
};
constexpr PropertyUse reads[] = {reads_pose, reads_twist, reads_joint_position, reads_joint_velocity};
constexpr PropertyUse writes[] = {
    {"latitude", "of the antenna"},
    {"longitude", "of the antenna"},
    {"altitude", "of the antenna"},
    {"gps.position", "east, north and up of the reference"},
    {"gps.velocity", "east, north, up"},
    {"gps.reference", "constant, as given"},
    mounting_writes,
};
constexpr Description description{
    .id = "sensor.gps",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Place on the earth and velocity of the device, as satellite navigation tells them",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one device.
struct Receiver {
  link_motion::LinkMotion antenna;
  Out<double> latitude, longitude, altitude;
  Out<Vec3> position, velocity;
};

class Gps final : public PerRobotAlgorithm<Receiver> {
 public:
  void step(const Step&, Range range) override {
    for (const Receiver& r : robots(range)) {
      const link_motion::FrameMotion m = r.antenna.now();
      *r.position = to_east_ * m.pose.position;
      *r.velocity = to_east_ * m.twist.linear;
      const GeodeticPlace place = plane_.place_of(*r.position);
      *r.latitude = place.latitude / radians_by_degree;
      *r.longitude = place.longitude / radians_by_degree;
      *r.altitude = place.altitude;
    }
  }

 private:
  void read_parameters(const Parameters& p) override {
    const std::span<const double> at = p.reals("reference");
    if (!(std::abs(at[0]) <= 90) || !(std::abs(at[1]) <= 360) || !std::isfinite(at[2]))
      throw Error("reference is " + number_text(at[0]) + ", " + number_text(at[1]) + ", " + number_text(at[2]) +
                  "; give a latitude from -90 to 90 deg, a longitude and an altitude in m");
    reference_ = {at[0], at[1], at[2]};
    plane_ = LocalPlane::at(reference_);
    to_east_ = rotation_about(Vec3::UnitZ(), p.real("heading"));
  }

  Receiver connect_robot(Connector& c, const Item& item) override {
    const std::span<const double> at = c.parameters().reals(mounting_offset.name);
    const Pose antenna{{at[0], at[1], at[2]}, Quat::Identity()};
    c.set(item.object, keys::sensor_origin, antenna);
    c.set(item.object, geodetic::key_reference, reference_);
    return {{c, *item.robot, carrying_link(c, item), antenna, link_motion::Order::twist},
            c.variable(item.object, keys::latitude, 0.0),
            c.variable(item.object, keys::longitude, 0.0),
            c.variable(item.object, keys::altitude, 0.0),
            c.variable(item.object, keys::gps_position, Vec3(0, 0, 0)),
            c.variable(item.object, keys::gps_velocity, Vec3(0, 0, 0))};
  }

  Vec3 reference_ = Vec3::Zero();  ///< deg, deg, m
  LocalPlane plane_;
  Quat to_east_ = Quat::Identity();  ///< from the axes of the world to east, north, up
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Gps>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_gps", .version = description.version, .licence = "MIT",
            .summary = "A receiver of satellite navigation", .algorithms = algorithms)
