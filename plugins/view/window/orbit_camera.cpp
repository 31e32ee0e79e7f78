// SPDX-License-Identifier: MIT
#include "orbit_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::view {

namespace {

/// Returns the distance in m from which all of a ball is visible.
double viewing_distance(double radius) { return std::max(1.0, 2.2 * radius); }

}  // namespace

void OrbitCamera::show_box(const Vec3& low, const Vec3& high) {
  target_ = 0.5 * (low + high);
  distance_ = viewing_distance(0.5 * (high - low).norm());
  azimuth_ = -2.2;
  elevation_ = 0.6;
}

void OrbitCamera::look_from(const Vec3& from, const Vec3& to) {
  const Vec3 back = from - to;
  target_ = to;
  distance_ = std::max(0.05, back.norm());
  azimuth_ = elementary::atan2(back.y(), back.x());
  elevation_ = elementary::asin(std::clamp(back.z() / distance_, -1.0, 1.0));
}

void OrbitCamera::rotate(double across, double down, double height) {
  const double rad = std::numbers::pi / height;
  azimuth_ -= across * rad;
  elevation_ = std::clamp(elevation_ + down * rad, -1.55, 1.55);
}

void OrbitCamera::shift(double across, double down, double height, double fov) {
  const double metres = 2 * distance_ * elementary::tan(0.5 * fov) / height;
  const Mat3 axes = orientation().toRotationMatrix();
  target_ += axes.col(1) * (across * metres) + axes.col(2) * (down * metres);
}

void OrbitCamera::zoom(double notches) {
  distance_ = std::clamp(distance_ * elementary::pow(0.85, notches), 0.05, 1e4);
}

void OrbitCamera::follow(const Pose& target) {
  if (mode == Mode::follow) target_ = target.position;
  carrier_ = target;
}

void OrbitCamera::approach(const Vec3& middle, double radius, double part, bool keeps_distance) {
  target_ += part * (middle - target_);
  if (!keeps_distance) distance_ += part * (viewing_distance(radius) - distance_);
}

Quat OrbitCamera::orientation() const { return from_rpy(0, elevation_, azimuth_ + std::numbers::pi); }

Pose OrbitCamera::pose() const {
  if (mode == Mode::first_person) return carrier_;
  const Quat q = orientation();
  return {target_ - q * Vec3(distance_, 0, 0), q};
}

}  // namespace muro::view
