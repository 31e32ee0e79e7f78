// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "muro/shape.hpp"

namespace muro::host {

/// The underside of a convex shape as a function of x and y; placement lowers it onto the ground.
class ConvexBottom {
 public:
  /// `at`: pose of the shape in the world. `corners`: corners of the convex hull of a mesh.
  ConvexBottom(const Shape& shape, const Pose& at, std::span<const Vec3> corners);

  /// Returns the point that is furthest along `direction` (unit).
  Vec3 furthest(const Vec3& direction) const;
  double low(int axis) const { return low_[axis]; }    ///< m, lower side of the box around the shape
  double high(int axis) const { return high_[axis]; }  ///< m, upper side of the box around the shape
  /// Whether the vertical line through a point meets that box.
  bool is_near(const Vec3& point) const {
    return (point.array() >= low_.array()).head<2>().all() && (point.array() <= high_.array()).head<2>().all();
  }

  /// Height (m) of the shape's lowest point on the vertical line through x and y, which are within the box around it.
  /// Outside of the shape, a steep continuation of it, so that the function is convex.
  double height(double x, double y) const;

 private:
  Vec3 furthest_in_shape(const Vec3& direction) const;

  const Shape shape_;
  const Pose at_;
  Eigen::Matrix3Xd corners_;  ///< m, in the world
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

/// Vertical distance of a shape from touching a surface of triangles from above.
class RiseAbove {
 public:
  /// `least`: lower values do not matter (m).
  RiseAbove(const ConvexBottom& bottom, std::optional<double> least)
      : bottom_(bottom), most_(least.value_or(-std::numeric_limits<double>::infinity())) {}
  const ConvexBottom& bottom() const { return bottom_; }

  /// Corners (m), counter-clockwise seen from above.
  using Triangle = std::array<Vec3, 3>;
  void add(const Triangle& triangle);
  /// Returns the height (m) by which the shape must be raised so that the whole surface is below its bottom and touches
  /// it in one point; less than 0 when it may be lowered. Returns `least` when that is more, and nothing when there is
  /// no `least` and no triangle below or above the shape.
  std::optional<double> rise();

 private:
  void look_at_edges();
  struct Bound {
    double rise;  ///< m: rise over the plane of the triangle
    Triangle triangle;
  };
  const ConvexBottom& bottom_;
  double most_;
  std::vector<Bound> bounds_;  ///< bounds of triangles that the shape touches, if at all, at an edge
};

}  // namespace muro::host
