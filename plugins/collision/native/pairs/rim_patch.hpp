// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "pairs/depth_function.hpp"

namespace muro::native {

/// The depth function of two cylinders for normals on one side of each: that of the two rims there,
///
///     h(n) = n . offset + radius_0 |n x disc_0| + radius_1 |n x disc_1|.
///
/// Where it has a minimum m, the farthest point is p = offset + radius_0 c_0 + radius_1 c_1 = m n, with units c_j at
/// right angles to disc_j, towards n. `most`, m, is a bound of minima that are of interest; none is below 0.
class RimPatch {
 public:
  /// `s0`, `s1`: the signs of n . disc_0 and n . disc_1.
  RimPatch(const DepthFunction& h, double s0, double s1)
      : h_(h), s_{s0, s1}, offset_(h.offset + s0 * h.half[0] * h.disc[0] + s1 * h.half[1] * h.disc[1]) {}

  /// The point of the difference that lies farthest along the unit vector n.
  Vec3 support(const Vec3& n) const {
    const Vec3 a = n - n.dot(h_.disc[0]) * h_.disc[0], b = n - n.dot(h_.disc[1]) * h_.disc[1];
    return offset_ + a * (h_.radius[0] / std::sqrt(a.squaredNorm())) + b * (h_.radius[1] / std::sqrt(b.squaredNorm()));
  }

  /// Whether there may be a minimum on the side of w, which is at right angles to both axes; `sine`: of the angle
  /// between them. No component of p is above `most`: those along disc_0 and disc_1 bound the angles of c_1 and c_0
  /// with the plane of both axes, and that along w holds the angles against each other.
  bool may_hold_minimum(const Vec3& w, double sine, double most) const {
    const Interval up0 = rise(offset_.dot(h_.disc[1]), h_.radius[0] * sine, most),
                   up1 = rise(offset_.dot(h_.disc[0]), h_.radius[1] * sine, most);
    if (up0.low > up0.high || up1.low > up1.high) return false;
    const double along = -offset_.dot(w);
    return along >= h_.radius[0] * up0.low + h_.radius[1] * up1.low - most &&
           along <= h_.radius[0] * up0.high + h_.radius[1] * up1.high + most;
  }

  /// Axes nearly parallel, and n near them: whether all minima lie within a small angle of the axes. There h is convex
  /// over the plane that touches the sphere, so there is one.
  bool minima_are_near_axes(double sine, double most) const {
    if (s_[0] * s_[1] * h_.disc[0].dot(h_.disc[1]) < 0 || sine > small) return false;
    // At the angle x from disc_0: h >= depth cos x + slope sin x - lag; concave, so the ends decide.
    const double depth = s_[0] * offset_.dot(h_.disc[0]), lag = h_.radius[1] * sine;
    const double slope = h_.radius[0] + h_.radius[1] - (offset_ - s_[0] * depth * h_.disc[0]).norm();
    return depth * std::cos(small) + slope * std::sin(small) - lag >= most && slope - lag >= most;
  }

  /// About where that one is; none: at an axis, or above `most`. A least depth of 0 is assumed: then
  /// radius_0 c_0 + radius_1 c_1 makes a triangle with -offset, seen along the axes.
  std::optional<Vec3> minimum_near_axes(double most) const {
    if (s_[0] * offset_.dot(h_.disc[0]) * std::cos(small) - h_.radius[0] * std::sin(small) > most) return {};
    const Vec3 up = s_[0] * h_.disc[0], second = s_[1] * h_.disc[1];
    const Vec3 tip = second / second.dot(up) - up;  // of the second axis, seen from that of the first
    const Vec3 to = -(offset_ - offset_.dot(up) * up);
    const double r0 = h_.radius[0], r1 = h_.radius[1], length = to.norm();
    const double cosine = (length * length + r0 * r0 - r1 * r1) / (2 * length * r0);
    if (!(std::abs(cosine) < 1)) return {};
    const Vec3 x = to / length, y = up.cross(x);
    for (const double sine : {std::sqrt(1 - cosine * cosine), -std::sqrt(1 - cosine * cosine)}) {
      const Vec3 c0 = cosine * x + sine * y, c1 = (to - r0 * c0) / r1;
      // up + s c0 = up + tip + t c1
      const double area = up.dot(c0.cross(c1)), s = up.dot(tip.cross(c1)) / area, t = up.dot(tip.cross(c0)) / area;
      if (s > 0 && t > 0 && s < 1) return (up + s * c0).normalized();
    }
    return {};
  }

 private:
  static constexpr double small = 0.1;  ///< rad
  struct Interval {
    double low, high;
  };
  /// The sines of angles whose cosines make |offset + reach * cosine| <= most.
  static Interval rise(double offset, double reach, double most) {
    const double nearest = std::max(0.0, std::abs(offset) - most) / reach, farthest = (std::abs(offset) + most) / reach;
    if (nearest > 1 + 1e-9) return {1, 0};
    const auto sine_of = [](double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); };
    return {sine_of(farthest), sine_of(nearest)};
  }

  const DepthFunction& h_;
  const double s_[2];
  const Vec3 offset_;  ///< m, between the middles of the rims
};

}  // namespace muro::native
