// SPDX-License-Identifier: MIT
// A magnetometer: the magnetic field of the earth in the axes of the device.
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/sensor/common/internal_sensor/mounted.hpp"
#include "plugins/sensor/common/internal_sensor/property_uses.hpp"

namespace {

using namespace muro;
using namespace muro::internal_sensor;

/// SDFormat's default of a world's magnetic_field.
constexpr double sdformat_field[] = {5.5645e-6, 22.8758e-6, -42.3884e-6};
constexpr Parameter parameters[] = {
    mounting_offset,
    mounting_rpy,
    reals("field", "T", sdformat_field, "of the earth, along the axes of the world").of_length(3),
};
constexpr PropertyUse reads[] = {reads_pose, reads_joint_position};
constexpr PropertyUse writes[] = {{"magnetic_field", "in the axes of the device"}, mounting_writes};
constexpr Description description{
    .id = "sensor.magnetometer",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "Magnetic field of the earth in the axes of the device",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

/// Data of one device.
struct Device {
  link_motion::LinkMotion motion;
  Out<Vec3> magnetic_field;
};

class Magnetometer final : public PerRobotAlgorithm<Device> {
 public:
  void step(const Step&, Range range) override {
    for (const Device& d : robots(range)) *d.magnetic_field = d.motion.now().pose.orientation.conjugate() * field_;
  }

 private:
  void read_parameters(const Parameters& p) override { field_ = Vec3(p.reals("field").data()); }
  Device connect_robot(Connector& c, const Item& item) override {
    return {device_motion(c, item, link_motion::Order::pose),
            c.variable(item.object, keys::magnetic_field, Vec3(0, 0, 0))};
  }

  Vec3 field_ = Vec3::Zero();  ///< T, world axes
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Magnetometer>(description)};

}  // namespace

MURO_PLUGIN(.name = "sensor_magnetometer", .version = description.version, .licence = "MIT",
            .summary = "A magnetometer", .algorithms = algorithms)
