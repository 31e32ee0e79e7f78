// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "muro/geometry.hpp"
#include "subsystem.hpp"

namespace muro::sdf_devices {

/// A sensor, followed by its errors.
using Subsystems = std::vector<Subsystem>;

/// Reads a <sensor> of SDFormat on a link or a joint of a robot as subsystems of a scenario. Ranges, rate, noise and
/// pose are those of the file. Features without a counterpart are reported. Names are those of the file, see
/// Device::place.
Device read_sensor(Element& sensor, const std::string& mounted_on, Messages& messages);

/// A <pose> of SDFormat.
struct DevicePose {
  Pose pose{Vec3::Zero(), Quat::Identity()};  ///< in the frame around it, m
  Vec3 rpy = Vec3::Zero();                    ///< the same rotation as fixed-axis roll, pitch, yaw, rad
  /// Pose of a device `within` this one, in the frame around this one.
  DevicePose operator*(const DevicePose& within) const;
};

/// One <sensor> that is being read.
struct SensorReading {
  Fields& fields;  ///< children of <sensor>
  std::string type;
  std::string name;  ///< name of the subsystem
  std::string mounted_on;
  DevicePose pose;  ///< in the frame of its link
  std::optional<double> rate;
  FileLocation location;

  /// Returns a subsystem with mount, rate and pose of the sensor, or of a device `within` it.
  Subsystem begin(const std::string& called, std::string_view use, const DevicePose& within = {}) const;
};

Subsystems read_lidar(SensorReading& s);
Subsystems read_cameras(SensorReading& s);
Subsystems read_imu(SensorReading& s);
Subsystems read_magnetometer(SensorReading& s);
Subsystems read_gps(SensorReading& s);
Subsystems read_contact(SensorReading& s);
Subsystems read_force_torque(SensorReading& s);

/// Reads the <pose> of a sensor or camera in its parent. Warns and returns nothing if the pose is given in another
/// frame.
std::optional<DevicePose> take_pose(Fields& fields);

}  // namespace muro::sdf_devices
