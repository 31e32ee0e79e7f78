// SPDX-License-Identifier: MIT
#include "standing.hpp"

#include <algorithm>
#include <cmath>

namespace muro::ground {

namespace {

constexpr double least_upright = 0.17;  ///< cosine of the angle of the z axis with the vertical: 80 deg
constexpr double steepest = 5;          ///< tangent
constexpr double largest_turn = 0.5;    ///< rad, in one iteration
constexpr int most_iterations = 12;     ///< two or three are enough, unless points change between cells
constexpr double accuracy = 1e-7;       ///< m, rad: of the last step; the remaining error is about its square

}  // namespace

/// Reads heading, slopes and place of a pose.
void Standing::take(const Pose& pose) {
  const Mat3 r = pose.orientation.toRotationMatrix();
  is_lying_ = r(2, 2) < least_upright;
  if (is_lying_) return;
  const double level = std::sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
  cosine_ = r(0, 0) / level, sine_ = r(1, 0) / level;
  along_ = r(2, 0) / level;
  across_ = (sine_ * r(0, 2) - cosine_ * r(1, 2)) / r(2, 2);
  double weight = 0;
  middle_ = Vec3::Zero();
  for (const ContactPoint& p : points_) middle_ += p.weight * p.at, weight += p.weight;
  middle_ /= weight;
  place_ = pose * middle_;
}

void Standing::set_axes() {
  const double x = 1 / std::sqrt(1 + along_ * along_), z = 1 / std::sqrt(1 + along_ * along_ + across_ * across_);
  axes_.col(0) = Vec3(x, 0, along_ * x);
  axes_.col(2) = Vec3(-along_ * z, -across_ * z, z);
  axes_.col(1) = axes_.col(2).cross(axes_.col(0));
}

Standing::Row Standing::row(const ContactPoint& point) const {
  Row row;
  const double from_x = point.at.x() - middle_.x(), from_y = point.at.y() - middle_.y();
  row.arm = from_x * axes_.col(0) + from_y * axes_.col(1) + (point.at.z() - middle_.z()) * axes_.col(2);
  const Vec3 at = place_ + turned(row.arm);
  const std::optional<Ground> ground = terrain_.ground_at(at.x(), at.y());
  row.gap = at.z() - (ground ? ground->height : (before_ * point.at).z());
  row.gradient = Vec3::UnitZ();
  if (ground) {
    row.gradient.x() = -(cosine_ * ground->slope_x + sine_ * ground->slope_y);
    row.gradient.y() = sine_ * ground->slope_x - cosine_ * ground->slope_y;
  }
  const Vec3 &a = row.arm, &g = row.gradient;
  const double x = axes_(0, 0), z = axes_(2, 0);  // of the base's x axis; its y is 0
  row.jacobian = {1, g.x() * a.z() - a.x(), -g.x() * z * a.y() + g.y() * (z * a.x() - x * a.z()) + x * a.y()};
  return row;
}

void Standing::NormalEquations::add(double weight, const Vec3& row, double value) {
  const double x = weight * row.x(), y = weight * row.y(), z = weight * row.z();
  xx += x * row.x(), xy += x * row.y(), xz += x * row.z();
  yy += y * row.y(), yz += y * row.z(), zz += z * row.z();
  right += Vec3(x * value, y * value, z * value);
}

/// Solves the equations by Cramer's rule.
Vec3 Standing::NormalEquations::solution() const {
  const double ax = yy * zz - yz * yz, ay = xz * yz - xy * zz, az = xy * yz - xz * yy;
  const double by = xx * zz - xz * xz, bz = xy * xz - xx * yz, cz = xx * yy - xy * xy;
  const double determinant = xx * ax + xy * ay + xz * az;
  if (!(determinant > 0)) return Vec3::Zero();
  return Vec3(ax * right.x() + ay * right.y() + az * right.z(), ay * right.x() + by * right.y() + bz * right.z(),
              az * right.x() + bz * right.y() + cz * right.z()) /
         determinant;
}

/// Uses Gauss and Newton's iteration over height, pitch and roll.
void Standing::settle(const Pose& before, Pose& pose) {
  before_ = before;
  take(pose);
  if (is_lying_) return;
  for (int i = 0; i < most_iterations; ++i) {
    set_axes();
    NormalEquations least;
    for (const ContactPoint& p : points_) {
      const Row r = row(p);
      least.add(p.weight, r.jacobian, -r.gap);
    }
    const Vec3 change = least.solution();
    const double pitch = std::clamp(change.y(), -largest_turn, largest_turn);
    const double roll = std::clamp(change.z(), -largest_turn, largest_turn);
    const double ascent = 1 + along_ * along_;
    place_.z() += change.x();
    across_ = std::clamp(across_ + roll * std::sqrt(ascent) * (1 + across_ * across_ / ascent), -steepest, steepest);
    along_ = std::clamp(along_ - pitch * ascent, -steepest, steepest);
    if (change.cwiseAbs().maxCoeff() < accuracy) break;
  }
  set_axes();
  Mat3 in_world;
  for (int i = 0; i < 3; ++i) in_world.col(i) = turned(axes_.col(i));
  Quat orientation(in_world);
  if (orientation.dot(pose.orientation) < 0) orientation.coeffs() = -orientation.coeffs();
  pose.orientation = orientation.normalized();
  pose.position = place_ - in_world * middle_;
}

Twist Standing::velocity(const Pose& pose, const Gliding& along) {
  take(pose);
  if (is_lying_) return {pose.orientation * Vec3(along.x, along.y, 0), pose.orientation * Vec3(0, 0, along.yaw_rate)};
  set_axes();
  const Vec3 turn = along.yaw_rate * axes_.col(2);
  const Vec3 gliding = axes_ * Vec3(along.x, along.y, 0) + turn.cross(axes_ * middle_);  // of the middle
  NormalEquations least;
  for (const ContactPoint& p : points_) {
    const Row r = row(p);
    least.add(p.weight, r.jacobian, -r.gradient.dot(gliding + turn.cross(r.arm)));
  }
  const Vec3 rates = least.solution();
  const Vec3 angular = turn + rates.y() * Vec3::UnitY() + rates.z() * axes_.col(0);
  const Vec3 linear = gliding + Vec3(0, 0, rates.x()) - angular.cross(axes_ * middle_);
  return {turned(linear), turned(angular)};
}

}  // namespace muro::ground
