// SPDX-License-Identifier: MIT
// Properties of sensors, and measurements that robots make of themselves.
#pragma once

#include "muro/geometry.hpp"
#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

// Sensors: properties of the sensor's object, whose pose is that of the link it is mounted on.
inline constexpr Key<Pose> sensor_origin{"sensor.origin", "m",
                                         "of the device's frame in the frame of the sensor's object"};
/// Constant on the sensor's object.
inline constexpr Key<ObjectId> sensor_link{"sensor.link", "1", "the link or joint that the sensor is mounted on"};

// Measurements of the robot itself: properties of the sensor's object, named as the fields of sensor_msgs and nav_msgs.
// The device's frame is `sensor.origin` in the frame of the link that carries it.
inline constexpr Key<Vec3> angular_velocity{"angular_velocity", "rad/s", "of the device, axes of the device"};
inline constexpr Key<Vec3> linear_acceleration{
    "linear_acceleration", "m/s^2", "specific force at the device, axes of the device: upwards and g at rest"};
inline constexpr Key<Quat> orientation{"orientation", "1", "of the device's frame in the world"};
inline constexpr Key<Vec3> magnetic_field{"magnetic_field", "T", "at the device, axes of the device"};
inline constexpr Key<Wrench> sensed_wrench{
    "wrench", "N, N m", "by what lies beyond the sensor on what carries it: axes of the device, at its origin"};
/// Constant on the object of an encoder: the unit of its readings, "rad or m", is that of this joint.
inline constexpr Key<ObjectId> encoder_joint{
    "encoder.joint", "1", "the joint that it looks at; of several the first, where all turn or all shift"};
inline constexpr Key<double> encoder_position{"encoder.position", "rad or m", "of the joint, as counted"};
inline constexpr Key<double> encoder_velocity{"encoder.velocity", "rad/s or m/s", "of the joint, as measured"};
inline constexpr Key<std::int64_t> encoder_count{"encoder.count", "1", "steps of the encoder from position 0"};
inline constexpr Key<std::uint32_t> foot_contact{"foot.contact", "1", "1: the foot stands on something",
                                                 Role::motion_trait};
inline constexpr Key<double> foot_force{"foot.force", "N", "along z of the device, upwards: sum of the cells"};
inline constexpr Key<Vec3> foot_center_of_pressure{
    "foot.center_of_pressure", "m", "where the force acts: in the frame of the device, 0 without a force"};
inline constexpr Key<double> foot_cells{"foot.cells", "N", "array: the force on each cell"};
inline constexpr Key<std::uint32_t> bumper_pressed{"bumper.pressed", "1", "1: something touches the bumper"};
inline constexpr Key<Pose> odometry_pose{"odometry.pose", "m", "of the base where the run began, by its wheels"};
inline constexpr Key<Twist> odometry_twist{"odometry.twist", "m/s, rad/s",
                                           "of the base, by its wheels, axes of the base"};
inline constexpr Key<double> latitude{"latitude", "deg", "of the device, WGS 84, north is positive"};
inline constexpr Key<double> longitude{"longitude", "deg", "of the device, WGS 84, east is positive"};
inline constexpr Key<double> altitude{"altitude", "m", "of the device above the ellipsoid of WGS 84"};
inline constexpr Key<Vec3> gps_position{"gps.position", "m", "of the device in the world: east, north, up"};
inline constexpr Key<Vec3> gps_velocity{"gps.velocity", "m/s", "of the device: east, north, up"};
inline constexpr Key<Pose> true_pose{"truth.pose", "m", "of the device's frame in the frame of reference"};
inline constexpr Key<Twist> true_twist{"truth.twist", "m/s, rad/s",
                                       "of the device against the frame of reference, axes of that frame"};
inline constexpr Key<Twist> true_acceleration{"truth.acceleration", "m/s^2, rad/s^2",
                                              "of the device in the world, world axes, at its origin"};

}  // namespace muro::keys
