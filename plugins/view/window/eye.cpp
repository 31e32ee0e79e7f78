// SPDX-License-Identifier: MIT
#include "eye.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace muro::view {

void Eye::look_at_all(const Vec3& low, const Vec3& high) {
  middle_ = 0.5 * (low + high);
  distance_ = std::max(1.0, 1.1 * (high - low).norm());
  azimuth_ = -2.2;
  elevation_ = 0.6;
}

void Eye::look_from(const Vec3& from, const Vec3& to) {
  const Vec3 back = from - to;
  middle_ = to;
  distance_ = std::max(0.05, back.norm());
  azimuth_ = std::atan2(back.y(), back.x());
  elevation_ = std::asin(std::clamp(back.z() / distance_, -1.0, 1.0));
}

void Eye::turn(double across, double down, double height) {
  const double rad = std::numbers::pi / height;
  azimuth_ -= across * rad;
  elevation_ = std::clamp(elevation_ + down * rad, -1.55, 1.55);
}

void Eye::shift(double across, double down, double height, double fov) {
  const double metres = 2 * distance_ * std::tan(0.5 * fov) / height;
  const Mat3 axes = turned().toRotationMatrix();
  middle_ += axes.col(1) * (across * metres) + axes.col(2) * (down * metres);
}

void Eye::zoom(double notches) { distance_ = std::clamp(distance_ * std::pow(0.85, notches), 0.05, 1e4); }

void Eye::follow(const Pose& target) {
  if (mode == Mode::follow) middle_ = target.position;
  carrier_ = target;
}

Quat Eye::turned() const { return from_rpy(0, elevation_, azimuth_ + std::numbers::pi); }

Pose Eye::pose() const {
  if (mode == Mode::first_person) return carrier_;
  const Quat q = turned();
  return {middle_ - q * Vec3(distance_, 0, 0), q};
}

}  // namespace muro::view
