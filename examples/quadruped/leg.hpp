// SPDX-License-Identifier: MIT
// A leg of three joints: abduction about x, hip and knee about y, as in most quadrupeds.
#pragma once

#include <algorithm>
#include <cmath>

#include "../common/angle.hpp"
#include "../common/two_bones.hpp"
#include "../common/vector.hpp"
#include "muro_elementary.h"

namespace quadruped {

using examples::Vector;

/// Masses of thigh, shank and foot, kg, with their centres in the middle of thigh and shank and in the foot.
struct LegMasses {
  double thigh = 0, shank = 0, foot = 0;
  double sum() const { return thigh + shank + foot; }
};

/// Lengths of a leg, m. Points and angles refer to a frame with the axes of the body (x forward, y left, z up) and its
/// origin on the axis of abduction. With all angles 0 the leg hangs straight down.
struct Leg {
  Vector hip;            ///< origin of this frame in the frame of the body
  double abduction = 0;  ///< from the axis of abduction to the plane of thigh and shank, along y: negative on the right
  double thigh = 0, shank = 0;
  double bend = -1;  ///< sign of the angle of the knee; -1: it points backwards

  /// Returns the middle of the foot, m, for the angles abduction, hip and knee of `q` in rad.
  Vector foot(const Vector& q) const {
    const double along = -thigh * muro_sin(q.y) - shank * muro_sin(q.y + q.z);
    const double down = -thigh * muro_cos(q.y) - shank * muro_cos(q.y + q.z);
    const double c = muro_cos(q.x), s = muro_sin(q.x);
    return {along, abduction * c - down * s, abduction * s + down * c};
  }

  /// Derivatives of a point by the three angles, m/rad.
  struct Jacobian {
    Vector columns[3];
    Vector operator*(const Vector& rates) const {
      return rates.x * columns[0] + rates.y * columns[1] + rates.z * columns[2];
    }
    /// Returns efforts of the joints, N m, that press the foot with this force, N, against a support.
    Vector efforts(const Vector& force) const {
      return {dot(columns[0], force), dot(columns[1], force), dot(columns[2], force)};
    }
    double determinant() const { return dot(columns[0], cross(columns[1], columns[2])); }
    /// Returns rates of the joints, rad/s, for this velocity of the foot. They stay bounded when the leg is stretched
    /// and the determinant falls below `least`, m^3 (Nakamura and Hanafusa, J. Dynamic Systems 108, 1986).
    Vector rates(const Vector& velocity, double least) const {
      const double d = determinant(), by = d / (d * d + least * least);
      return by * Vector{dot(cross(columns[1], columns[2]), velocity), dot(cross(columns[2], columns[0]), velocity),
                         dot(cross(columns[0], columns[1]), velocity)};
    }
  };
  /// `beside`: present place of a point of the shank, seen from the middle of the foot: m, axes of the body. A ball
  /// rolls on the point where it touches.
  Jacobian jacobian(const Vector& q, const Vector& beside = {}) const {
    const Vector p = foot(q);
    const double c = muro_cos(q.x), s = muro_sin(q.x);
    const double down = -thigh * muro_cos(q.y) - shank * muro_cos(q.y + q.z);
    const double knee_along = -shank * muro_cos(q.y + q.z), knee_down = shank * muro_sin(q.y + q.z);
    const Vector axis{0, c, s}, turned = cross(axis, beside);  // axis of hip and knee
    return {{Vector{0, -p.z, p.y} + cross(Vector{1, 0, 0}, beside), Vector{down, p.x * s, -p.x * c} + turned,
             Vector{knee_along, -knee_down * s, knee_down * c} + turned}};
  }

  /// Returns efforts of the joints, N m, that carry the leg's own weight. `up`: the vertical in the frame of the body.
  Vector weight(const Vector& q, const LegMasses& m, const Vector& up, double gravity) const {
    const Points p = points(q);
    const Vector axis{0, muro_cos(q.x), muro_sin(q.x)};  // axis of hip and knee
    const Vector low = cross(p.foot, m.foot * up) + cross(0.5 * (p.knee + p.foot), m.shank * up);
    const Vector all = low + cross(0.5 * (p.hip + p.knee), m.thigh * up);  // moments about the origin
    const double lower = m.foot + m.shank, mass = lower + m.thigh;
    return gravity *
           Vector{all.x, dot(axis, all - mass * cross(p.hip, up)), dot(axis, low - lower * cross(p.knee, up))};
  }
  /// Returns the sum of masses times their places, kg m.
  Vector moment(const Vector& q, const LegMasses& m) const {
    const Points p = points(q);
    return (0.5 * m.thigh) * (p.hip + p.knee) + (0.5 * m.shank) * (p.knee + p.foot) + m.foot * p.foot;
  }
  /// Returns the inertia that each joint moves, kg m^2, with the leg bent by a right angle and the others held.
  Vector inertia(const LegMasses& m) const {
    const double low = m.shank * shank * shank / 3 + m.foot * shank * shank;
    const double mid = m.thigh * thigh * thigh / 3 + (m.shank + m.foot) * thigh * thigh + low;
    return {mid + (m.thigh + m.shank + m.foot) * abduction * abduction, mid, low};
  }

  /// Joints and foot, m.
  struct Points {
    Vector hip, knee, foot;
  };
  Points points(const Vector& q) const {
    const double c = muro_cos(q.x), s = muro_sin(q.x), along = -thigh * muro_sin(q.y), down = -thigh * muro_cos(q.y);
    const Vector top{0, abduction * c, abduction * s};
    return {top, top + Vector{along, -down * s, down * c}, foot(q)};
  }

  /// Returns the angles that bring the foot to `p`. A point out of reach is drawn near along the line from the hip.
  Vector angles(const Vector& p) const {
    const double across = p.y * p.y + p.z * p.z - abduction * abduction;
    const double down = -std::sqrt(std::max(across, 1e-6));
    const double reach = thigh + shank, nearest = std::abs(thigh - shank);
    const double distance = std::clamp(std::sqrt(p.x * p.x + down * down), nearest + 1e-9, reach - 1e-9);
    const examples::TwoBones bones{thigh, shank};
    const double knee = bend * bones.bend_for(distance * distance);
    const double lifted = muro_atan2(p.z, p.y) - muro_atan2(down, abduction);
    return {examples::wrapped(lifted), muro_atan2(-p.x, -down) - bones.lead(knee), knee};
  }
};

}  // namespace quadruped
