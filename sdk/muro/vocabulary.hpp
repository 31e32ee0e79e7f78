// SPDX-License-Identifier: MIT
// The standard names. Terms follow URDF, SDF and ROS; units are SI; frames follow REP-103.
#pragma once

#include "muro/key.hpp"
#include "muro/scene.hpp"

namespace muro::keys {

// Motion of bodies. `pose` and `twist` are those of the body's frame in the world.
inline constexpr Key<Pose> pose{"pose", "m", "pose of the body's frame in the world"};
inline constexpr Key<Pose> initial_pose{"pose.initial", "m", "of a robot's base at the start"};
inline constexpr Key<Twist> initial_twist{"twist.initial", "m/s, rad/s", "of a robot's base at the start, world axes"};
inline constexpr Key<Twist> twist{"twist", "m/s, rad/s", "velocity of the body's frame, world axes, at its origin"};
/// Of the last step of the motion that moves the robot: the derivative of its twist. It is there where a sensor reads
/// it, see toolkit/accelerations.hpp. Before the first step a robot that forces move and that touches nothing falls.
inline constexpr Key<Twist> acceleration{"acceleration", "m/s^2, rad/s^2",
                                         "of the frame of a robot's base, world axes, at its origin, in the last step"};
inline constexpr Key<Wrench> external_wrench{
    "wrench.external", "N, N m", "sum of what acts on a body from outside: world axes, at the body's origin"};
inline constexpr Key<Wrench> contact_wrench{
    "wrench.contact", "N, N m", "what contacts did to a body in the last step: world axes, at the body's origin",
    Role::motion_trait};
/// By the motion that moves the robot, on links where somebody reads it: all that it has let act on the link in the
/// step that `acceleration` is of. So Newton's and Euler's equations of the link hold with both. Not a number after a
/// step of a motion that no force moves.
inline constexpr Key<Wrench> applied_wrench{
    "wrench.applied", "N, N m",
    "what acted on a body from outside in the last step, contacts too: world axes, at the body's origin"};
inline constexpr Key<Vec3> gravity{"gravity", "m/s^2", "on the world object, world axes"};
/// Constant on the world object: a FrictionRule (toolkit/pair_surface.hpp); the smaller where it is missing.
inline constexpr Key<std::uint32_t> friction_rule{"friction.rule", "1",
                                                  "how a pair's friction follows from those of its two shapes"};

// Who moves a robot, and who finds what its contacts do: properties of its base.
/// Which of the motions that a robot lists moves it, from 0; see Item::level.
inline constexpr Key<std::uint32_t> motion_level{"motion.level", "1", "which of its motions moves the robot, from 0"};
inline constexpr Key<std::int32_t> motion_level_target{
    "motion.level.target", "1", "which motion is to move it; -1: the one that does", Role::command};
/// Array, constant: the names of the motions that a robot lists.
inline constexpr Key<TextId> motion_level_names{"motion.level.names", "1", "names of the motions of the robot"};
/// Constant: this robot is the shadow of the one with that base. It is moved by the same commands, touches what is in
/// the scene and is neither touched nor seen.
inline constexpr Key<ObjectId> shadow_of{"shadow.of", "1", "base of the robot whose shadow this one is"};
/// A motion that forces move says here who answers for contacts. 0: nobody, no force moves the robot. contact_for_all:
/// the contact algorithm, for all of them. Any other number names a world: it answers for contacts of its robots with
/// each other, with scenery and with robots that no force moves; for those with robots that forces move in another way
/// the contact algorithm does.
inline constexpr Key<std::uint64_t> contact_world{"contact.world", "1", "who answers for contacts of the robot",
                                                  Role::motion_trait};
inline constexpr std::uint64_t contact_for_all = 1;
/// How many steps the twist is older than the pose. 0 where pose and twist are those of one instant and a constant
/// force F carries the centre by v h + F h^2 / 2m; 0.5 for semi-implicit Euler, v' = v + F h / m, x' = x + v' h, whose
/// velocities are those of the middles of steps (leapfrog). Contact needs it to keep energy and angular momentum.
inline constexpr Key<double> twist_lag{"twist.lag", "1", "steps by which the twist is older than the pose",
                                       Role::motion_trait};
/// Of a robot whose motion resolves contacts among its own links and leaves it to the collision algorithm to find them.
/// Links that one joint connects, or only fixed ones, do not touch.
inline constexpr Key<std::uint32_t> self_collision{"self_collision", "1", "1: `contacts` has those among its links",
                                                   Role::motion_trait};

// What a body is.
inline constexpr Key<Inertia> inertial{"inertial", "kg, m, kg m^2", "mass, centre of mass, inertia about it"};
inline constexpr Key<Shape> collision_shapes{"collision.shapes", "m", "array: what the body collides with"};
inline constexpr Key<Shape> visual_shapes{"visual.shapes", "m", "array: what the body looks like"};

// Joints: properties of the joint's object. Revolute and continuous joints turn, prismatic ones shift.
inline constexpr Key<double> joint_position{"joint.position", "rad or m", "along the axis, 0 as modelled"};
inline constexpr Key<double> initial_joint_position{"joint.position.initial", "rad or m", "at the start"};
inline constexpr Key<double> joint_velocity{"joint.velocity", "rad/s or m/s", "along the axis"};
/// As `acceleration`.
inline constexpr Key<double> joint_acceleration{"joint.acceleration", "rad/s^2 or m/s^2",
                                                "along the axis, in the last step"};
inline constexpr Key<double> joint_effort{"joint.effort", "N m or N", "what the drive applies along the axis",
                                          Role::motion_trait};
inline constexpr Key<double> joint_position_target{"joint.position.target", "rad or m", "wanted position",
                                                   Role::command};
inline constexpr Key<double> joint_velocity_target{"joint.velocity.target", "rad/s or m/s", "wanted velocity",
                                                   Role::command};
inline constexpr Key<double> joint_acceleration_target{"joint.acceleration.target", "rad/s^2 or m/s^2",
                                                       "wanted acceleration", Role::command};
inline constexpr Key<double> joint_effort_target{"joint.effort.target", "N m or N", "wanted effort", Role::command};
// Constants of a joint, by the reader of its model.
/// The DriveMode (toolkit/joint_drives.hpp) of the actuator that the model has for it, or passive where it has
/// actuators for other joints alone.
inline constexpr Key<std::uint32_t> joint_drive{"joint.drive", "1", "what the joint follows by its model"};
/// Of a joint that follows positions: what its actuator does, stiffness (target - position) - damping velocity.
inline constexpr Key<double> joint_drive_stiffness{"joint.drive.stiffness", "N m/rad or N/m",
                                                   "of the joint's position drive by its model"};
inline constexpr Key<double> joint_drive_damping{"joint.drive.damping", "N m s/rad or N s/m",
                                                 "of the joint's position drive by its model"};
// What a drive in front of the motion brings with it, for joints that efforts drive. A motion finds them in
// `connect_by_name`.
inline constexpr Key<double> joint_drive_friction{"joint.drive.friction", "N m or N",
                                                  "the largest friction of the drive, beside that of the joint"};
inline constexpr Key<double> joint_drive_armature{"joint.drive.armature", "kg m^2 or kg",
                                                  "inertia of the drive's rotor, beside that of the joint"};

// Commands to a whole robot: properties of its base.
inline constexpr Key<Twist> command_twist{"command.twist", "m/s, rad/s",
                                          "wanted velocity of the base, axes of the base", Role::command};
inline constexpr Key<Pose> command_pose{"command.pose", "m", "wanted pose of the base in the world", Role::command};

// The scene.
inline constexpr Key<SceneIndex> scene_index{"scene.index", "m", "on the world object: shapes and boxes for search"};
inline constexpr Key<Contact> contacts{"contacts", "m", "list on the base of a robot: where it touches"};
// Who answers for contacts writes them one by one where somebody reads them, on the base of a robot.
/// Of the last step, by the engine that moves the robot. A robot that no force moves has no such list: what it does to
/// others stands in theirs.
inline constexpr Key<ContactWrench> contact_wrenches_of_motion{
    "contact.wrenches.motion", "m, N, N m", "list on the base of a robot: what its engine's contacts did to it",
    Role::motion_trait};
/// By the contact algorithm, for the step that begins; also on robots that no force moves and that others push.
inline constexpr Key<ContactWrench> contact_wrenches_of_law{
    "contact.wrenches.law", "m, N, N m", "list on the base of a robot: what the contact algorithm does to it"};
/// Arrays, constant, on the world object: the named places of a scenario.
inline constexpr Key<TextId> place_names{"place.names", "1", "name of the place to which each rectangle belongs"};
inline constexpr Key<double> place_rectangles{"place.rectangles", "m",
                                              "for each rectangle: x and y of its centre, lengths along x and y"};

// Sensors: properties of the sensor's object, whose pose is that of the link it is mounted on.
inline constexpr Key<Pose> sensor_origin{"sensor.origin", "m",
                                         "of the device's frame in the frame of the sensor's object"};
/// Constant on the sensor's object.
inline constexpr Key<ObjectId> sensor_link{"sensor.link", "1", "the link or joint that the sensor is mounted on"};

// What robots feel of themselves: properties of the sensor's object, named as the fields of sensor_msgs and nav_msgs.
// The device's frame is `sensor.origin` in the frame of the link that carries it.
inline constexpr Key<Vec3> angular_velocity{"angular_velocity", "rad/s", "of the device, axes of the device"};
inline constexpr Key<Vec3> linear_acceleration{
    "linear_acceleration", "m/s^2", "specific force at the device, axes of the device: upwards and g at rest"};
inline constexpr Key<Quat> orientation{"orientation", "1", "of the device's frame in the world"};
inline constexpr Key<Vec3> magnetic_field{"magnetic_field", "T", "at the device, axes of the device"};
inline constexpr Key<Wrench> sensed_wrench{
    "wrench", "N, N m", "by what lies beyond the sensor on what carries it: axes of the device, at its origin"};
inline constexpr Key<double> encoder_position{"encoder.position", "rad or m", "of the joint, as counted"};
inline constexpr Key<double> encoder_velocity{"encoder.velocity", "rad/s or m/s", "of the joint, as measured"};
inline constexpr Key<std::int64_t> encoder_count{"encoder.count", "1", "steps of the encoder from position 0"};
inline constexpr Key<std::uint32_t> foot_contact{"foot.contact", "1", "1: the foot stands on something"};
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

// Laser scanners: properties of the sensor's object. Angles are counter-clockwise about z, 0 along x.
inline constexpr Key<double> laser_min_angle{"laser.min_angle", "rad", "direction of the first ray of a row"};
inline constexpr Key<double> laser_angle_increment{"laser.angle_increment", "rad",
                                                   "between neighbouring rays of a row"};
inline constexpr Key<std::uint32_t> laser_columns{"laser.columns", "1", "rays in a row"};
inline constexpr Key<std::uint32_t> laser_rows{"laser.rows", "1", "rows; rays are stored row by row from below"};
inline constexpr Key<double> laser_min_range{"laser.min_range", "m", "nothing nearer is seen"};
inline constexpr Key<double> laser_max_range{"laser.max_range", "m", "nothing farther is seen; such a ray reads this"};
inline constexpr Key<double> ranges{"ranges", "m", "array: true distance along each ray"};
inline constexpr Key<double> measured_ranges{"ranges.measured", "m", "array: the distance as the device reports it"};
inline constexpr Key<ObjectId> laser_hits{"laser.hits", "1", "array: the object each ray hits, or none"};
inline constexpr Key<double> laser_incidence{"laser.incidence", "rad",
                                             "array: between each ray and the normal of the surface it hits"};

// Cameras: properties of the sensor's object; x forward, as every sensor frame here.
inline constexpr Key<std::uint32_t> camera_width{"camera.width", "1", "pixels"};
inline constexpr Key<std::uint32_t> camera_height{"camera.height", "1", "pixels"};
inline constexpr Key<double> camera_horizontal_fov{"camera.horizontal_fov", "rad", "opening angle"};
inline constexpr Key<double> camera_fx{"camera.fx", "px", "focal length across"};
inline constexpr Key<double> camera_fy{"camera.fy", "px", "focal length down"};
inline constexpr Key<double> camera_cx{"camera.cx", "px", "column of the optical axis, from the left edge"};
inline constexpr Key<double> camera_cy{"camera.cy", "px", "row of the optical axis, from the upper edge"};
inline constexpr Key<std::uint8_t> camera_image{"camera.image", "1", "array: rgb, rows from the top"};
inline constexpr Key<float> camera_depth{"camera.depth", "m",
                                         "array: distance along the optical axis, infinite where nothing is"};
inline constexpr Key<ObjectId> camera_labels{"camera.labels", "1", "array: the object each pixel shows, or none"};

}  // namespace muro::keys
