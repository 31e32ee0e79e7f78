// SPDX-License-Identifier: MIT
#include "host/commands/standard_properties.hpp"

#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

constexpr const KeyInfo* motion[] = {
    &keys::pose,           &keys::initial_pose,   &keys::initial_twist, &keys::twist,         &keys::external_wrench,
    &keys::contact_wrench, &keys::applied_wrench, &keys::gravity,       &keys::friction_rule, &keys::acceleration,
};
constexpr const KeyInfo* levels[] = {
    &keys::motion_level, &keys::motion_level_target, &keys::motion_level_rule, &keys::motion_level_names,
    &keys::shadow_of,    &keys::contact_world,       &keys::twist_lag,         &keys::self_collision,
};
constexpr const KeyInfo* bodies[] = {&keys::inertial, &keys::collision_shapes, &keys::visual_shapes};
constexpr const KeyInfo* joints[] = {
    &keys::joint_position,        &keys::initial_joint_position,
    &keys::joint_velocity,        &keys::joint_acceleration,
    &keys::joint_effort,          &keys::joint_position_target,
    &keys::joint_velocity_target, &keys::joint_acceleration_target,
    &keys::joint_effort_target,   &keys::joint_drive,
    &keys::joint_drive_stiffness, &keys::joint_drive_damping,
    &keys::joint_drive_friction,  &keys::joint_drive_armature,
};
constexpr const KeyInfo* commands[] = {&keys::command_twist, &keys::command_pose};
constexpr const KeyInfo* scene[] = {
    &keys::scene_index,
    &keys::contacts,
    &keys::contact_wrenches_of_motion,
    &keys::contact_wrenches_of_law,
    &keys::carried_mass,
    &keys::impact_step,
    &keys::impact_time,
    &keys::impact,
    &keys::place_names,
    &keys::place_rectangles,
};
constexpr const KeyInfo* sensors[] = {&keys::sensor_origin, &keys::sensor_link};
constexpr const KeyInfo* internal_sensors[] = {
    &keys::angular_velocity,
    &keys::linear_acceleration,
    &keys::orientation,
    &keys::magnetic_field,
    &keys::sensed_wrench,
    &keys::encoder_position,
    &keys::encoder_velocity,
    &keys::encoder_count,
    &keys::encoder_joint,
    &keys::foot_contact,
    &keys::foot_force,
    &keys::foot_cells,
    &keys::foot_center_of_pressure,
    &keys::bumper_pressed,
    &keys::odometry_pose,
    &keys::odometry_twist,
    &keys::latitude,
    &keys::longitude,
    &keys::altitude,
    &keys::gps_position,
    &keys::gps_velocity,
    &keys::true_pose,
    &keys::true_twist,
    &keys::true_acceleration,
};
constexpr const KeyInfo* lasers[] = {
    &keys::laser_min_angle,
    &keys::laser_angle_increment,
    &keys::laser_min_elevation,
    &keys::laser_elevation_increment,
    &keys::laser_columns,
    &keys::laser_rows,
    &keys::laser_min_range,
    &keys::laser_max_range,
    &keys::ranges,
    &keys::measured_ranges,
    &keys::laser_hits,
    &keys::laser_incidence,
};
constexpr const KeyInfo* cameras[] = {
    &keys::camera_width, &keys::camera_height, &keys::camera_horizontal_fov, &keys::camera_fx,    &keys::camera_fy,
    &keys::camera_cx,    &keys::camera_cy,     &keys::camera_image,          &keys::camera_depth, &keys::camera_labels,
};
constexpr const KeyInfo* model_files[] = {
    &keys::heightmap_values, &keys::heightmap_columns,      &keys::mesh_corners,
    &keys::model_subsystems, &keys::model_subsystem_places, &keys::visual_materials,
};
constexpr const KeyInfo* radios[] = {
    &keys::radio_send_bytes, &keys::radio_send_size,      &keys::radio_send_receiver, &keys::radio_send_number,
    &keys::radio_received,   &keys::radio_received_bytes, &keys::radio_keep,          &keys::radio_last,
    &keys::radio_last_bytes, &keys::radio_counters,
};

constexpr PropertyGroup groups[] = {
    {"Motion of bodies", "Every body of a robot has them, unless the description says otherwise.", motion},
    {"Motions, levels of detail and contacts of a robot", "The base of a robot has them.", levels},
    {"Bodies", "Every body of a robot and of the scenery has them; they are constant.", bodies},
    {"Joints", "The object of a joint has them; angles for joints that rotate, lengths for those that translate.",
     joints},
    {"Commands to a whole robot", "The base of a robot has them.", commands},
    {"Scene and contacts", "The description names the object.", scene},
    {"Sensors", "The object of a sensor has them; its pose is that of the link on which it is mounted.", sensors},
    {"Internal sensors",
     "On the sensor's object, named as in sensor_msgs; `sensor.origin` is the device's frame in that link.",
     internal_sensors},
    {"Laser scanners", "The object of the sensor has them. Angles are counter-clockwise about z, 0 along x.", lasers},
    {"Cameras", "The object of the sensor has them; x points forward, as in every sensor frame.", cameras},
    {"Radios", "The object of the radio has them. Control code writes what is to be sent and reads what has come.",
     radios},
    {"Models", "A reader of models sets them on the base or on a body, for the host. A robot does not keep them.",
     model_files},
};

}  // namespace

std::span<const PropertyGroup> standard_properties() { return groups; }

}  // namespace muro::host
