// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "muro/shape.hpp"

namespace muro::host {

/// The underside of a convex shape as a function of x and y: what placement lowers on the ground.
class ConvexBottom {
 public:
  /// `at`: of the shape in the world. `corners`: of the convex hull of a mesh.
  ConvexBottom(const Shape& shape, const Pose& at, std::span<const Vec3> corners);

  /// The point that is furthest along `direction` (unit).
  Vec3 furthest(const Vec3& direction) const;
  double low(int axis) const { return low_[axis]; }    ///< m, of the box around it
  double high(int axis) const { return high_[axis]; }  ///< the same
  /// Whether the vertical through a point goes through that box.
  bool is_near(const Vec3& point) const {
    return (point.array() >= low_.array()).head<2>().all() && (point.array() <= high_.array()).head<2>().all();
  }

  /// m: its lowest point on the vertical through x and y, which are within the box around it. Beside the shape, a steep
  /// continuation of that, so that the function is convex.
  double height(double x, double y) const;

 private:
  Vec3 furthest_in_shape(const Vec3& direction) const;

  const Shape shape_;
  const Pose at_;
  Eigen::Matrix3Xd corners_;  ///< m, in the world
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

/// How far a shape is from touching a surface of triangles from above, along the vertical.
class RiseAbove {
 public:
  /// `least`: what is less does not matter (m).
  RiseAbove(const ConvexBottom& bottom, std::optional<double> least)
      : bottom_(bottom), most_(least.value_or(-std::numeric_limits<double>::infinity())) {}
  const ConvexBottom& bottom() const { return bottom_; }

  /// m, counter-clockwise seen from above.
  using Triangle = std::array<Vec3, 3>;
  void add(const Triangle& triangle);
  /// By how much (m) the shape must be raised so that nothing of the surface is above its bottom and one point of it
  /// touches; less than 0: may be lowered. `least` where that is more; nothing where there is none and no triangle is
  /// below or above it.
  std::optional<double> rise();

 private:
  void look_at_edges();
  struct Bound {
    double rise;  ///< m: that of the plane of the triangle
    Triangle triangle;
  };
  const ConvexBottom& bottom_;
  double most_;
  std::vector<Bound> bounds_;  ///< of triangles that the shape touches at an edge, if at all
};

}  // namespace muro::host
