// SPDX-License-Identifier: MIT
// Gyroscopes and accelerometers, alone or in one device.
#pragma once

#include "mounted.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "property_uses.hpp"

namespace muro::internal_sensor {

/// Quantities that such a device measures.
struct Measures {
  bool angular_velocity = false, linear_acceleration = false, orientation = false;
};

/// Data of a device; outputs that it does not have are unset.
struct InertialDevice {
  link_motion::LinkMotion motion;
  Out<Vec3> angular_velocity, linear_acceleration;
  Out<Quat> orientation;
};

class InertialSensor : public PerRobotAlgorithm<InertialDevice> {
 public:
  explicit InertialSensor(const Measures& measures) : measures_(measures) {}

  void connect_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < c.items().size(); ++i) robot(i).motion.check(c);
  }

  /// Computes f = R^T (a - g), w = R^T w, with the axes R of the device.
  void step(const Step&, Range range) override {
    for (const InertialDevice& d : robots(range)) {
      const link_motion::FrameMotion m = d.motion.now();
      const Quat to_device = m.pose.orientation.conjugate();
      if (d.angular_velocity) *d.angular_velocity = to_device * m.twist.angular;
      if (d.linear_acceleration) *d.linear_acceleration = to_device * Vec3(m.acceleration.linear - gravity_);
      if (d.orientation) *d.orientation = m.pose.orientation.normalized();
    }
  }

 private:
  InertialDevice connect_robot(Connector& c, const Item& item) override {
    using link_motion::Order;
    gravity_ = gravity_of(c);
    InertialDevice d;
    d.motion = device_motion(c, item, measures_.linear_acceleration ? Order::acceleration : Order::twist);
    if (measures_.angular_velocity) d.angular_velocity = c.variable(item.object, keys::angular_velocity, Vec3(0, 0, 0));
    if (measures_.linear_acceleration)
      d.linear_acceleration = c.variable(item.object, keys::linear_acceleration, Vec3(0, 0, 0));
    if (measures_.orientation) d.orientation = c.variable(item.object, keys::orientation, Quat(1, 0, 0, 0));
    return d;
  }

  Measures measures_;
  Vec3 gravity_ = Vec3::Zero();  ///< m/s^2, world axes
};

}  // namespace muro::internal_sensor
