// SPDX-License-Identifier: MIT
#include "impact.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro::penalty {
namespace {

Vec3 spin_by(const ImpactBody& body, const Vec3& torque) { return vector_of(body.mobility.inertia * plain(torque)); }

/// Returns twice the kinetic energy that the push gives to bodies at rest.
double energy_of(const Push& push, const ImpactBody& self, const ImpactBody* other) {
  const auto of = [&](const ImpactBody& body, const Vec3& torque) {
    return body.mobility.mass * push.force.squaredNorm() + torque.dot(spin_by(body, torque));
  };
  return of(self, push.torque) + (other ? of(*other, push.other_torque) : 0);
}

/// Returns the change of the velocity of `self` over the other at a point, by a push.
Vec3 velocity_by(const Push& push, const ImpactPoint& p, const ImpactBody& self, const ImpactBody* other) {
  Vec3 change = self.mobility.mass * push.force + spin_by(self, push.torque).cross(p.lever);
  if (other) change += other->mobility.mass * push.force + spin_by(*other, push.other_torque).cross(p.other_lever);
  return change;
}

/// Finds the impulses along the normals and returns their sum.
Push resolve_normals(std::span<ImpactPoint> points, const ImpactBody& self, const ImpactBody* other) {
  Push unit, push;
  double work = 0, restitution = 0;
  for (const ImpactPoint& p : points) {
    const double square = p.approach * p.approach;
    unit.add(p, p.approach * p.normal);
    work += square;
    restitution += p.restitution * square;
  }
  const double scale = (1 + restitution / work) * work / energy_of(unit, self, other);
  for (ImpactPoint& p : points) {
    p.impulse = scale * p.approach * p.normal;
    push.add(p, p.impulse);
  }
  return push;
}

void resolve_friction(std::span<ImpactPoint> points, const Push& normals, const ImpactBody& self,
                      const ImpactBody* other) {
  const auto slip_of = [&](const ImpactPoint& p) {
    const Vec3 velocity = p.velocity + velocity_by(normals, p, self, other);
    return Vec3(velocity - p.normal * p.normal.dot(velocity));
  };
  Push unit;
  double work = 0;
  for (const ImpactPoint& p : points) {
    const Vec3 slip = slip_of(p);
    unit.add(p, -slip);
    work += slip.squaredNorm();
  }
  const double energy = energy_of(unit, self, other);
  if (!(energy > 0)) return;
  double scale = work / energy;
  for (const ImpactPoint& p : points) {
    const double slip = slip_of(p).norm(), most = p.friction * p.impulse.norm();
    if (scale * slip > most) scale = most / slip;
  }
  for (ImpactPoint& p : points) {
    const Vec3 slip = slip_of(p);  // its impulse so far is along the normal
    p.impulse -= scale * slip;
  }
}

/// Returns the inverse effective mass of a body for an impulse at the end of a lever, 1/kg.
Mat3 inverse_mass_at(const ImpactBody& body, const Vec3& lever) {
  const Mat3 arm = (Mat3() << 0, -lever.z(), lever.y(), lever.z(), 0, -lever.x(), -lever.y(), lever.x(), 0).finished();
  Mat3 turning;
  for (int k = 0; k < 3; ++k) turning.col(k) = spin_by(body, arm.col(k));
  return body.mobility.mass * Mat3::Identity() - arm * turning;
}

/// The path of an impulse at one point while its part along the normal grows (Routh, Dynamics of a System of Rigid
/// Bodies, 1905, chapter V). It is on the cone, against the slip, until the slip ends. Then the point sticks, or slides
/// on if the cone is too narrow to stick.
class ImpulsePath {
 public:
  ImpulsePath(const Mat3& inverse_mass, const Vec3& normal, double friction)
      : inverse_mass_(inverse_mass), normal_(normal), friction_(friction), held_(held_direction()) {}

  /// Returns the impulse from `velocity` (m/s, of the own point over the other) until the points part with `parting`
  /// (m/s). Returns nothing if no impulse parts them.
  std::optional<Vec3> impulse(const Vec3& velocity, double parting) const {
    constexpr int most_turns = 200;
    constexpr double no_slip = 1e-9;  // of the speed
    const double least = no_slip * velocity.norm(), all = parting - normal_.dot(velocity);
    Vec3 at = velocity, sum = Vec3::Zero();
    for (int i = 0; i < most_turns; ++i) {
      const double left = parting - normal_.dot(at);
      if (!(left > no_slip * all)) return sum;
      const Vec3 slip = across(at);
      const bool slides = slip.norm() > least;
      const Vec3 direction = slides ? Vec3(normal_ - friction_ * slip.normalized()) : held_;
      const double yields = normal_.dot(inverse_mass_ * direction);
      if (!(yields > 0)) return {};
      const double part = std::min(left / yields, slides ? lasts(slip, direction, all / yields) : left / yields);
      sum += part * direction;
      at += part * inverse_mass_ * direction;
      if (slides && part < left / yields && across(at).norm() < 1e-6 * slip.norm()) at -= across(at);
    }
    return {};
  }

 private:
  Vec3 across(const Vec3& v) const { return v - normal_ * normal_.dot(v); }
  /// Returns the impulse along the normal (N s) for which this direction of the slip may be used as a piece of the
  /// path. `all`: impulse of the whole path in this direction.
  double lasts(const Vec3& slip, const Vec3& direction, double all) const {
    constexpr int pieces = 64;
    const Vec3 change = across(inverse_mass_ * direction), unit = slip.normalized();
    const double along = change.dot(unit);
    double most = along < 0 ? -slip.norm() / along : std::numeric_limits<double>::infinity();
    if ((change - along * unit).norm() > 1e-9 * change.norm())  // the slip turns
      most = std::min(most, all / pieces);
    return most;
  }
  /// Returns the direction of the impulse without slip: such that the point sticks, or on the cone in that direction.
  Vec3 held_direction() const {
    const Vec3 u = normal_.unitOrthogonal(), v = normal_.cross(u);
    Eigen::Matrix<double, 3, 2> plane;
    plane << u, v;
    const Vec3 friction =
        -plane * (plane.transpose() * inverse_mass_ * plane).inverse() * (plane.transpose() * inverse_mass_ * normal_);
    const double size = friction.norm();
    return normal_ + (size > friction_ ? friction_ / size : 1) * friction;
  }

  Mat3 inverse_mass_;
  Vec3 normal_;
  double friction_;
  Vec3 held_;
};

/// Resolves one point, where friction and the normal impulse may change each other. Returns false if this leads to no
/// rebound or to a rebound that gains energy.
bool resolve_point(ImpactPoint& p, const ImpactBody& self, const ImpactBody* other) {
  Mat3 inverse_mass = inverse_mass_at(self, p.lever);
  if (other) inverse_mass += inverse_mass_at(*other, p.other_lever);
  const auto impulse = ImpulsePath(inverse_mass, p.normal, p.friction).impulse(p.velocity, p.restitution * p.approach);
  constexpr double rounding = 1e-9;
  if (!impulse) return false;
  const double gained = impulse->dot(p.velocity + 0.5 * inverse_mass * *impulse);
  if (gained > rounding * impulse->norm() * p.velocity.norm()) return false;
  p.impulse = *impulse;
  return true;
}

}  // namespace

FreeBody::FreeBody(const Bodies& bodies, const DynamicBody& base)
    : mass(&bodies.masses[base.mass]),
      origin(base.pose->position),
      orientation(base.pose->orientation),
      centre(*base.pose * Vec3(mass->com)),
      velocity(base.twist->at(centre - origin)),
      spin(base.twist->angular) {}

law::Mobility<double> FreeBody::mobility_before(double since) const {
  const Quat q = rotation_of(Vec3(-since * spin)) * orientation;
  return law::mobility_of(*mass, {plain(origin), {q.x(), q.y(), q.z(), q.w()}});
}

Vec3 FreeBody::spin_before(double since) const {
  const auto matrix_of = [](const law::Symmetric<double>& m) {
    return (Mat3() << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz).finished();
  };
  const Vec3 momentum = matrix_of(mobility_before(0).inertia).inverse() * spin;
  return matrix_of(mobility_before(since).inertia) * momentum;
}

std::optional<TimeOfImpact> time_of_impact(double depth, double speed, double acceleration) {
  const double square = speed * speed - 2 * acceleration * depth;
  if (!(speed > 0) || !(square > 0)) return {};
  const double approach = std::sqrt(square);
  return TimeOfImpact{2 * depth / (speed + approach), approach};
}

void resolve_impact(std::span<ImpactPoint> points, const ImpactBody& self, const ImpactBody* other) {
  if (points.size() == 1 && resolve_point(points[0], self, other)) return;
  resolve_friction(points, resolve_normals(points, self, other), self, other);
}

std::optional<TimeOfImpact> impact_of(const StepContext& context, const Contact& contact, const FrictionAnchor* before,
                                      const Vec3& velocity, double step, bool other_falls) {
  const double speed = -velocity.dot(contact.normal), elapsed = context.elapsed;
  if (!(speed > context.impact_speed)) return {};
  const double reach = lasting_reach + lasting_slips * elapsed * (velocity + speed * contact.normal).norm();
  if (before && (before->point - contact.point).squaredNorm() < reach * reach) return {};
  const double fall = other_falls ? 0 : -context.gravity.dot(contact.normal);
  const std::optional<TimeOfImpact> time = time_of_impact(contact.depth, speed, fall);
  // Forces that are not known here may have slowed the bodies down; the path of another impact may have brought them
  // nearer.
  const double share = other_falls ? 4 : 1.5;
  if (!time || time->approach < context.impact_speed || time->since > share * std::max(elapsed, step)) return {};
  return time;
}

ImpactPoint::ImpactPoint(const StepContext& context, const Contact& contact, const TimeOfImpact& time,
                         const Vec3& relative, const FreeBody& self, const FreeBody* other)
    : at(contact.point),
      normal(contact.normal),
      // Across the surfaces, the point has the mean velocity of both; along them, it moves with the bodies.
      point_velocity(other ? Vec3(0.5 * (self.velocity + other->velocity))
                           : Vec3(self.velocity + 0.5 * contact.depth / time.since * contact.normal)),
      lever(contact.point - self.centre + time.since * (self.velocity - point_velocity)),
      other_lever(Vec3::Zero()),
      velocity(relative + self.spin_before(time.since).cross(lever) - self.spin.cross(contact.point - self.centre)),
      since(time.since),
      friction(contact.surface.friction),
      restitution(contact.surface.restitution),
      source(&contact) {
  if (other) {
    const Vec3 present = contact.point - other->centre;
    other_lever = present + since * (other->velocity - point_velocity);
    velocity -= other->spin_before(since).cross(other_lever) - other->spin.cross(present);
  } else {
    velocity -= since * context.gravity;
  }
  approach = std::max(-velocity.dot(normal), 0.5 * time.approach);
}

void ImpactPoint::add_motion(const law::Mobility<double>& self, const Vec3& pushed, const Vec3& turned) {
  velocity += self.mass * pushed + vector_of(self.inertia * plain(turned)).cross(lever);
  approach = -velocity.dot(normal);
}

void ImpactPoint::add_motion_of_other(const law::Mobility<double>& body, const Vec3& pushed, const Vec3& turned) {
  velocity -= body.mass * pushed + vector_of(body.inertia * plain(turned)).cross(other_lever);
  approach = -velocity.dot(normal);
}

double mean_since(std::span<const ImpactPoint> points) {
  double sum = 0;
  for (const ImpactPoint& p : points) sum += p.since;
  return sum / double(points.size());
}

void tell_impact(const Robot& robot, const ImpactPoint& point, double step) {
  Bodies::tell(robot, {point.source, 1})->wrench.force = point.impulse / step;
}

void add_impulse(const StepContext& context, double step, const ImpactPoint& point, const Vec3& impulse,
                 const FreeBody& body, Wrench& wrench, ImpactCorrection& correction) {
  const Vec3 lever = point.at - body.centre + point.since * (body.velocity - point.point_velocity);
  const Vec3 force = impulse / step, path = (point.since + 0.5 * step) * impulse;
  wrench.add_force(force, point.at - body.origin);
  // the lever is that of the middle of the step
  wrench.torque += (0.5 * step * (point.point_velocity - body.velocity)).cross(force);
  correction.path += path;
  correction.turn += lever.cross(path);
  // the fall of the body is no part of the impact
  correction.carried += path.cross(point.point_velocity + step * context.gravity);
}

}  // namespace muro::penalty
