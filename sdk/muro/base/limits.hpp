// SPDX-License-Identifier: MIT
// Ranges of values that can be simulated. Hosts check every value from a scenario, a model or set-up code against them.
// Readers of models may check earlier, while they know the line of a file. docs/guide/scenario.md lists the ranges with
// their reasons.
#pragma once

#include <cmath>
#include <string>

#include "muro/geometry.hpp"
#include "muro/robot.hpp"
#include "muro/shape.hpp"

namespace muro::limits {

/// Coordinates, m: neighbouring doubles are 1.5e-8 m apart there, close enough for contacts.
inline constexpr double position = 1e8;
/// Roll, pitch and yaw, rad: an angle of many turns has lost the digits that give its direction.
inline constexpr double angle = 1e6;
/// Lengths and radii of shapes, and scale factors of a mesh, m or 1: products of three of them, divided by a mass, stay
/// within the range of every engine's float.
inline constexpr double min_size = 1e-9, max_size = 1e6;
/// Mass of a body, kg.
inline constexpr double min_mass = 1e-9, max_mass = 1e9;
/// Entries of a tensor of inertia, kg m^2: the greatest mass at the greatest size.
inline constexpr double inertia = 1e21;
/// Components of gravity, m/s^2: thirty times that of the sun.
inline constexpr double gravity = 1e4;
/// Initial velocities, m/s and rad/s: more than any machine reaches.
inline constexpr double speed = 1e5, turn_rate = 1e5;
/// Positions of joints, and multipliers and offsets of mimic joints, rad or m.
inline constexpr double joint_position = 1e6;
/// Damping and friction of joints, N m s/rad, N s/m, N m or N.
inline constexpr double joint_resistance = 1e12;
/// Joint limits from this value on count as none: model files write 1e16 and similar values for no limit.
inline constexpr double no_joint_limit = 1e9;
/// Coulomb coefficients; a far smaller value already prevents all sliding.
inline constexpr double friction = 1e20;

/// Whether |x| is at most `limit`; false for NaN.
inline bool within(double limit, double x) { return std::abs(x) <= limit; }
inline bool within(double limit, const Vec3& v) {
  return within(limit, v.x()) && within(limit, v.y()) && within(limit, v.z());
}
/// Whether `x` is a size that a shape can have.
inline bool is_size(double x) { return x >= min_size && x <= max_size; }

// Each problem_of() returns what is wrong with a value, as the end of a sentence that begins with its name: "its
// position has ...". Empty: nothing is wrong.

inline std::string problem_of(const Pose& p) {
  if (!within(position, p.position)) return "has a coordinate that is not from -1e8 to 1e8 m";
  const double norm = p.orientation.norm();
  return norm > 0.999 && norm < 1.001 ? "" : "has an orientation that is no unit quaternion";
}

inline std::string problem_of(const Twist& t) {
  if (!within(speed, t.linear)) return "has a velocity that is not from -1e5 to 1e5 m/s along each axis";
  return within(turn_rate, t.angular) ? "" : "has an angular velocity that is not from -1e5 to 1e5 rad/s";
}

inline std::string problem_of(const Inertia& i) {
  if (!(i.mass == 0 || (i.mass > 0 && i.mass <= max_mass))) return "has a mass that is not from 0 to 1e9 kg";
  if (!within(max_size, i.com)) return "has its centre of mass at a coordinate that is not from -1e6 to 1e6 m";
  return within(inertia, Vec3(i.ixx, i.iyy, i.izz)) && within(inertia, Vec3(i.ixy, i.ixz, i.iyz))
             ? ""
             : "has an inertia with an entry that is not from -1e21 to 1e21 kg m^2";
}

inline std::string problem_of(const Shape& s) {
  const auto sizes = [&](std::initializer_list<double> all) {
    for (const double x : all)
      if (!is_size(std::abs(x))) return false;
    return true;
  };
  bool fine = true;
  switch (s.kind) {
    case ShapeKind::box:
    case ShapeKind::heightmap:
      fine = sizes({s.size.x(), s.size.y(), s.size.z()}) && s.size.minCoeff() > 0;
      break;
    case ShapeKind::sphere:
      fine = is_size(s.size.x());
      break;
    case ShapeKind::cylinder:
      fine = is_size(s.size.x()) && is_size(s.size.z());
      break;
    case ShapeKind::capsule:  // the straight part may have length 0
      fine = is_size(s.size.x()) && s.size.z() >= 0 && s.size.z() <= max_size;
      break;
    case ShapeKind::plane:
      break;
    case ShapeKind::mesh:
      if (!sizes({s.size.x(), s.size.y(), s.size.z()}))
        return "has a mesh with a factor of scale that is not from 1e-9 to 1e6";
  }
  if (!fine) return "has a size that is not from 1e-9 to 1e6 m";
  if (!(s.surface.friction >= 0 && s.surface.friction <= friction)) return "has a friction that is not from 0 to 1e20";
  if (!(s.surface.restitution >= 0 && s.surface.restitution <= 1)) return "has a restitution that is not from 0 to 1";
  const auto is_resistance = [](double length) { return length >= 0 && length <= max_size; };
  if (!is_resistance(s.surface.rolling_resistance) || !is_resistance(s.surface.spinning_resistance))
    return "has a rolling or spinning resistance that is not from 0 to 1e6 m";
  if (!s.color.allFinite()) return "has a color that is not finite";
  return problem_of(s.origin);
}

inline std::string problem_of(const JointLimits& l) {
  if (std::isnan(l.lower) || std::isnan(l.upper)) return "has a limit of position that is not a number";
  if (!(l.velocity >= 0) || !(l.effort >= 0)) return "has a limit of velocity or effort that is not 0 or more";
  const auto resistance = [](double x) { return x >= 0 && x <= joint_resistance; };
  if (!(l.armature >= 0 && l.armature <= inertia)) return "has an armature that is not from 0 to 1e21 kg m^2 or kg";
  return resistance(l.damping) && resistance(l.friction) ? "" : "has a damping or friction that is not from 0 to 1e12";
}

/// Returns `l` without limits that are so far away that they count as none.
inline JointLimits effective(JointLimits l) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (l.lower <= -no_joint_limit) l.lower = -none;
  if (l.upper >= no_joint_limit) l.upper = none;
  return l;
}

}  // namespace muro::limits
