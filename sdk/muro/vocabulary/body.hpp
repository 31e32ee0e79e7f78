// SPDX-License-Identifier: MIT
// Properties of bodies, of the robots that they belong to, and of the scene.
#pragma once

#include "muro/key.hpp"
#include "muro/scene.hpp"

namespace muro::keys {

// Motion of bodies. `pose` and `twist` are those of the body's frame in the world.
inline constexpr Key<Pose> pose{"pose", "m", "pose of the body's frame in the world"};
inline constexpr Key<Pose> initial_pose{"pose.initial", "m", "of a robot's base at the start"};
inline constexpr Key<Twist> initial_twist{"twist.initial", "m/s, rad/s", "of a robot's base at the start, world axes"};
inline constexpr Key<Twist> twist{"twist", "m/s, rad/s", "velocity of the body's frame, world axes, at its origin"};
/// Derivative of the twist in the last step of the motion that moves the robot. The property exists if a sensor reads
/// it, see toolkit/accelerations.hpp. Before the first step, a robot that forces move and that touches nothing falls.
inline constexpr Key<Twist> acceleration{"acceleration", "m/s^2, rad/s^2",
                                         "of the frame of a robot's base, world axes, at its origin, in the last step"};
inline constexpr Key<Wrench> external_wrench{
    "wrench.external", "N, N m", "sum of what acts on a body from outside: world axes, at the body's origin"};
/// Written by the motion that moves the robot, on links where something reads it: all that the motion has let act on
/// the link in the step of `acceleration`. So Newton's and Euler's equations of the link hold with both. The value is
/// not a number after a step of a motion without forces.
inline constexpr Key<Wrench> applied_wrench{
    "wrench.applied", "N, N m",
    "what acted on a body from outside in the last step, contacts too: world axes, at the body's origin"};
inline constexpr Key<Vec3> gravity{"gravity", "m/s^2", "on the world object, world axes"};

// Choice of the motion that moves a robot: properties of its base.
/// Number of the motion that moves the robot, among those that the robot lists, from 0; see Item::level.
inline constexpr Key<std::uint32_t> motion_level{"motion.level", "1", "which of its motions moves the robot, from 0"};
inline constexpr Key<std::int32_t> motion_level_target{
    "motion.level.target", "1", "which motion is to move it; -1: the one that does", Role::command};
/// Written by level.rules, read by the hand-over.
inline constexpr Key<std::int32_t> motion_level_rule{"motion.level.rule", "1",
                                                     "which motion is to move it by a rule that holds; -1: none holds"};
/// Array, constant: the names of the motions that a robot lists.
inline constexpr Key<TextId> motion_level_names{"motion.level.names", "1", "names of the motions of the robot"};
/// Constant: this robot is the shadow of the robot with that base. The same commands move it. It touches objects of the
/// scene, but nothing touches or sees it.
inline constexpr Key<ObjectId> shadow_of{"shadow.of", "1", "base of the robot whose shadow this one is"};

// Mass and shapes of a body.
inline constexpr Key<Inertia> inertial{"inertial", "kg, m, kg m^2", "mass, centre of mass, inertia about it"};
inline constexpr Key<Shape> collision_shapes{"collision.shapes", "m", "array: what the body collides with"};
inline constexpr Key<Shape> visual_shapes{"visual.shapes", "m", "array: what the body looks like"};

// Commands to a whole robot: properties of its base.
inline constexpr Key<Twist> command_twist{"command.twist", "m/s, rad/s",
                                          "wanted velocity of the base, axes of the base", Role::command};
inline constexpr Key<Pose> command_pose{"command.pose", "m", "wanted pose of the base in the world", Role::command};

// The scene.
inline constexpr Key<SceneIndex> scene_index{"scene.index", "m", "on the world object: shapes and boxes for search"};
/// Arrays, constant, on the world object: the named places of a scenario.
inline constexpr Key<TextId> place_names{"place.names", "1", "name of the place to which each rectangle belongs"};
inline constexpr Key<double> place_rectangles{"place.rectangles", "m",
                                              "for each rectangle: x and y of its centre, lengths along x and y"};

}  // namespace muro::keys
