// SPDX-License-Identifier: MIT
// Effective masses: how heavy two bodies are to each other where they touch.
#pragma once

#include "muro/geometry.hpp"

namespace muro::penalty {

/// What resists a force on a free body. World axes.
struct Mobility {
  double mass = 0;              ///< inverse, 1/kg
  Mat3 inertia = Mat3::Zero();  ///< inverse, 1/(kg m^2), about `centre`
  Vec3 centre = Vec3::Zero();   ///< centre of mass, m
};

/// Mobility of a point: along the normal, and the sum over both directions across it. 1/kg.
struct Yield {
  double along = 0;
  double across = 0;
  Yield operator+(const Yield& b) const { return {along + b.along, across + b.across}; }
};

/// Stiffness of a body on springs against shifts, and against turns about its centre of mass. World axes.
struct Resistance {
  Mat3 shift = Mat3::Zero();
  Mat3 turn = Mat3::Zero();
  void operator+=(const Resistance& b) {
    shift += b.shift;
    turn += b.turn;
  }
  /// No less than the largest eigenvalue of M^-1 K: of a matrix of two diagonal blocks it is at most the sum of
  /// theirs, and in a block at most its Frobenius norm.
  double greatest(const Mobility& body) const {
    const Mat3 x = body.inertia * turn;
    return body.mass * shift.norm() + std::sqrt(x.cwiseProduct(x.transpose()).sum());
  }
};

/// Contact points of one pair of bodies with one normal: touching is one event, which they share.
///
/// The points of a patch together act with the effective mass at their middle, 1 / (1/m + (r x n) . I^-1 (r x n)), each
/// with its part, so that a box that lands flat on four corners rebounds as a ball does.
class Patch {
 public:
  Patch(const Vec3& normal, const Vec3& origin) : normal_(normal), origin_(origin) {
    turn_ << 0, -normal.z(), normal.y(), normal.z(), 0, -normal.x(), -normal.y(), normal.x(), 0;
  }

  const Vec3& normal() const { return normal_; }
  double count() const { return count_; }
  void add(const Vec3& point) {
    const double x = point.x() - origin_.x(), y = point.y() - origin_.y(), z = point.z() - origin_.z();
    count_ += 1;
    x_ += x, y_ += y, z_ += z;
    xx_ += x * x, yy_ += y * y, zz_ += z * z;
    xy_ += x * y, xz_ += x * z, yz_ += y * z;
  }
  /// Of the middle of the points.
  Yield at_middle(const Mobility& body) const {
    const Vec3 r = origin_ + sum() / count_ - body.centre, turned = r.cross(normal_);
    const double along = turned.dot(body.inertia * turned);
    const double all = body.inertia.trace() * r.squaredNorm() - r.dot(body.inertia * r);
    return {body.mass + along, 2 * body.mass + all - along};
  }
  /// What springs in the points do to a body, each of stiffness `along` the normal and `across` it.
  Resistance resistance(const Mobility& body, double along, double across) const {
    const Vec3 shift = origin_ - body.centre;
    const Mat3 cross = sum() * shift.transpose();
    Mat3 squares;  // sum of r r^T
    squares << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
    squares += cross + cross.transpose() + count_ * shift * shift.transpose();
    Resistance k;
    k.shift = count_ * (across * Mat3::Identity() + (along - across) * normal_ * normal_.transpose());
    k.turn = across * (squares.trace() * Mat3::Identity() - squares) +
             (along - across) * turn_ * squares * turn_.transpose();
    return k;
  }

 private:
  Vec3 sum() const { return {x_, y_, z_}; }

  Vec3 normal_;
  Vec3 origin_;
  Mat3 turn_;  ///< turn_ * v = normal x v
  // Number, sum and second moments of the points from origin_, as plain numbers: they are updated point by point.
  double count_ = 0, x_ = 0, y_ = 0, z_ = 0;
  double xx_ = 0, yy_ = 0, zz_ = 0, xy_ = 0, xz_ = 0, yz_ = 0;
};

}  // namespace muro::penalty
