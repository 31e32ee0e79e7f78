// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "pairs/depth_function.hpp"

namespace muro::native {

/// Depth function of two cylinders for normals on one side of each. It is that of the two rims there:
///
///     h(n) = n . offset + radius_0 |n x disc_0| + radius_1 |n x disc_1|.
///
/// If it has a minimum m, the farthest point is p = offset + radius_0 c_0 + radius_1 c_1 = m n, with unit vectors c_j
/// at right angles to disc_j, towards n. `bound` (m) limits the minima that are of interest; none is below 0.
class RimPatch {
 public:
  /// `s0`, `s1`: the signs of n . disc_0 and n . disc_1.
  RimPatch(const DepthFunction& h, double s0, double s1)
      : h_(h), s_{s0, s1}, offset_(h.offset + s0 * h.half[0] * h.disc[0] + s1 * h.half[1] * h.disc[1]) {}

  /// Returns the point of the difference that lies farthest along the unit vector n.
  Vec3 support(const Vec3& n) const {
    const Vec3 a = n - n.dot(h_.disc[0]) * h_.disc[0], b = n - n.dot(h_.disc[1]) * h_.disc[1];
    return offset_ + a * (h_.radius[0] / std::sqrt(a.squaredNorm())) + b * (h_.radius[1] / std::sqrt(b.squaredNorm()));
  }

  /// Whether there may be a minimum on the side of w, which is at right angles to both axes. `sine`: sine of the angle
  /// between them. No component of p is above `bound`: those along disc_0 and disc_1 bound the angles of c_1 and c_0
  /// with the plane of both axes, and the component along w relates these angles to each other.
  bool may_hold_minimum(const Vec3& w, double sine, double bound) const {
    const Interval up0 = rise(offset_.dot(h_.disc[1]), h_.radius[0] * sine, bound),
                   up1 = rise(offset_.dot(h_.disc[0]), h_.radius[1] * sine, bound);
    if (up0.low > up0.high || up1.low > up1.high) return false;
    const double along = -offset_.dot(w);
    return along >= h_.radius[0] * up0.low + h_.radius[1] * up1.low - bound &&
           along <= h_.radius[0] * up0.high + h_.radius[1] * up1.high + bound;
  }

  /// Whether all minima lie within a small angle of the axes. This needs axes that are nearly parallel, n near them,
  /// and shapes that overlap little. Then h is convex over the tangent plane of the sphere, so there is one minimum.
  bool minima_are_near_axes(double sine, double bound) const {
    if (s_[0] * s_[1] * h_.disc[0].dot(h_.disc[1]) < 0 || sine > 0.1) return false;
    if (bound > 0.1 * std::min(h_.radius[0], h_.radius[1])) return false;
    // At the angle x from disc_0, h is at least at_0 cos x + at_90 sin x. That is concave if positive: its ends decide.
    const double depth = s_[0] * offset_.dot(h_.disc[0]), beside = (offset_ - s_[0] * depth * h_.disc[0]).norm();
    const double at_0 = depth - h_.radius[1] * sine,
                 at_90 = h_.radius[0] + h_.radius[1] * std::sqrt(1 - sine * sine) - beside;
    return at_0 * cosine_small + at_90 * sine_small >= bound && at_90 >= bound;
  }

  /// Returns a start for the search of that minimum; none if it is at an axis, or above `bound`.
  std::optional<Vec3> minimum_near_axes(double sine, double bound) const {
    const Vec3 up = s_[0] * h_.disc[0], second = s_[1] * h_.disc[1];
    const double r0 = h_.radius[0], r1 = h_.radius[1];
    if (offset_.dot(up) * cosine_small - r0 * sine_small > bound) return {};
    // At an axis h has the tip of a cone. The tip is the minimum if the rest of h falls less than the cone rises.
    const Vec3 descent0 = descent(up, second, r1 / sine), descent1 = descent(second, up, r0 / sine);
    const double steep0 = descent0.norm(), steep1 = descent1.norm();
    if (steep0 <= r0 || steep1 <= r1) return {};
    // Otherwise, if the minimum were 0, it would be where r0 c_0 + r1 c_1 = -offset, seen along the axes.
    const Vec3 to = offset_.dot(up) * up - offset_, tip = second / second.dot(up) - up;
    const double length = to.norm(), cosine = (length * length + r0 * r0 - r1 * r1) / (2 * length * r0);
    const Vec3 x = to / length, y = up.cross(x);
    const double rise = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    for (const double side : {rise, -rise}) {
      const Vec3 c0 = cosine * x + side * y, c1 = (to - r0 * c0) / r1;
      const double area = up.dot(c0.cross(c1)), s = up.dot(tip.cross(c1)) / area, t = up.dot(tip.cross(c0)) / area;
      if (s > 0 && t > 0 && s < 1) return (up + s * c0).normalized();
    }
    // Otherwise it is near an axis, from which h falls only slightly.
    const double over0 = (steep0 - r0) / r1, over1 = (steep1 - r1) / r0;
    if (over0 < over1) return (up + (sine * std::min(0.1, over0) / steep0) * descent0).normalized();
    return (second + (sine * std::min(0.1, over1) / steep1) * descent1).normalized();
  }

 private:
  static constexpr double sine_small = 0.29552020666133955, cosine_small = 0.955336489125606;  ///< of 0.3 rad
  struct Interval {
    double low, high;
  };
  /// Returns the negative gradient at the axis `at`, without the cone of that axis. `reach`: radius of the other disc
  /// divided by the sine between both.
  Vec3 descent(const Vec3& at, const Vec3& other, double reach) const {
    const Vec3 p = offset_ + reach * (at - at.dot(other) * other);
    return at.dot(p) * at - p;
  }
  /// Returns the sines of angles whose cosines make |offset + reach * cosine| <= bound.
  static Interval rise(double offset, double reach, double bound) {
    const double nearest = std::max(0.0, std::abs(offset) - bound) / reach,
                 farthest = (std::abs(offset) + bound) / reach;
    if (nearest > 1 + 1e-9) return {1, 0};
    const auto sine_of = [](double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); };
    return {sine_of(farthest), sine_of(nearest)};
  }

  const DepthFunction& h_;
  const double s_[2];
  const Vec3 offset_;  ///< m, between the centres of the rims
};

}  // namespace muro::native
