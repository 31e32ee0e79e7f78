// SPDX-License-Identifier: MIT
// Impacts: impulses between two bodies at the time of impact.
//
// Newton's law of restitution acts along the normal. Then Coulomb's friction stops the slip or reaches its limit. A
// single point follows Routh's path. The points of a contact patch act together: along their approach speeds the
// impulse is that of an exact solution. So an impact never gains energy, for any number of points.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "bodies.hpp"

namespace muro::penalty {

/// A robot that moves as one rigid body.
struct FreeBody {
  FreeBody(const Bodies& bodies, const DynamicBody& base);

  /// Return values a time `since` (s) ago, if no torque has acted since then.
  law::Mobility<double> mobility_before(double since) const;
  Vec3 spin_before(double since) const;

  const MassProperties* mass;
  Vec3 origin;  ///< m, world: origin of its base
  Quat orientation;
  Vec3 centre;          ///< m, world: centre of mass
  Vec3 velocity, spin;  ///< m/s, of the centre; rad/s
};

/// A body in an impact.
struct ImpactBody {
  law::Mobility<double> mobility;
};

/// Time of an impact, and the speed with which the bodies approached each other then.
struct TimeOfImpact {
  double since = 0;     ///< s
  double approach = 0;  ///< m/s
};
/// Returns the time of impact of bodies that overlap by `depth` (m), approach each other with `speed` (m/s) and are
/// accelerated towards each other by `acceleration` (m/s^2).
std::optional<TimeOfImpact> time_of_impact(double depth, double speed, double acceleration);

/// Returns the time of impact if a contact is an impact: it is new, began within the last step, and is faster than
/// contact at rest can be. `before`: the nearest friction anchor of its pair; null: none. `velocity`: of the own point
/// over the other (m/s); `step`: of the motion (s); `other_falls`: forces move the other body, too.
std::optional<TimeOfImpact> impact_of(const StepContext& context, const Contact& contact, const FrictionAnchor* before,
                                      const Vec3& velocity, double step, bool other_falls);

/// A contact point in an impact.
struct ImpactPoint {
  ImpactPoint() = default;
  /// `velocity` (m/s): of the own point over the other; `other`: null if no force moves it. Levers and velocities are
  /// those at the instant of the impact. So it keeps angular momentum and gains no energy.
  ImpactPoint(const StepContext& context, const Contact& contact, const TimeOfImpact& time, const Vec3& velocity,
              const FreeBody& self, const FreeBody* other);

  Vec3 at;                  ///< m, world
  Vec3 normal;              ///< unit, world: the direction in which `self` is pushed
  Vec3 point_velocity;      ///< m/s: velocity of the point itself
  Vec3 lever, other_lever;  ///< m, world: from the centres of mass
  Vec3 velocity;            ///< m/s, of `self` over the other
  double approach = 0;      ///< m/s, > 0
  double since = 0;         ///< s
  double friction = 0, restitution = 0;
  Vec3 impulse = Vec3::Zero();  ///< N s, on `self`; out
  const Contact* source = nullptr;

  /// Adds the velocity by an impulse (N s) and a torque impulse (N m s, about the centre) on `self` in other points.
  void add_motion(const law::Mobility<double>& self, const Vec3& pushed, const Vec3& turned);
  /// Adds the velocity by impulses on the other body.
  void add_motion_of_other(const law::Mobility<double>& body, const Vec3& pushed, const Vec3& turned);
};

/// Impulses (N s, N m s about the centres) on both bodies, summed.
struct Push {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), other_torque = Vec3::Zero();

  void add(const ImpactPoint& p, const Vec3& impulse) {
    force += impulse;
    torque += p.lever.cross(impulse);
    other_torque += p.other_lever.cross(impulse);
  }
};

/// Returns the friction anchor of a contact in an impact. It is far from every point, so that bodies that still
/// approach each other collide again.
inline FrictionAnchor anchor_of_impact(std::uint64_t pair) {
  return {.pair = pair, .point = Vec3::Constant(std::numeric_limits<double>::infinity())};
}

inline bool is_of_impact(const FrictionAnchor& anchor) {
  return std::abs(anchor.point.x()) == std::numeric_limits<double>::infinity();
}

/// Whether a contact of the pair was in an impact in the step before.
inline bool was_in_impact(std::span<const FrictionAnchor> before, std::uint64_t pair) {
  return std::any_of(before.begin(), before.end(),
                     [&](const FrictionAnchor& a) { return a.pair == pair && is_of_impact(a); });
}

/// Returns the mean time (s) since the impacts of some points.
double mean_since(std::span<const ImpactPoint> points);

/// Finds the impulses of the points of one patch. `other`: null if it does not move freely.
void resolve_impact(std::span<ImpactPoint> points, const ImpactBody& self, const ImpactBody* other);

/// Reports an impact in the list of its robot, as a force over a step (s).
void tell_impact(const Robot& robot, const ImpactPoint& point, double step);

/// Adds the impulse (N s) on a body to its wrench in a step (s) and to the correction of its path.
void add_impulse(const StepContext& context, double step, const ImpactPoint& point, const Vec3& impulse,
                 const FreeBody& body, Wrench& wrench, ImpactCorrection& correction);

}  // namespace muro::penalty
