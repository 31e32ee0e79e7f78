// SPDX-License-Identifier: MIT
#include "host/scenario/convex_bottom.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::host {

namespace {

constexpr double steepness = 100;  ///< of the continuation outside of a shape
constexpr double hair = 1e-7;      ///< m
constexpr std::size_t most_bounds = 16'384;

double cross(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Maximum (m), over a segment, of its height above the bottom, which is a concave function (golden section). Minus
/// infinity when the segment is outside of the shape.
double highest_above(const ConvexBottom& bottom, const Vec3& a, const Vec3& b) {
  double most = -std::numeric_limits<double>::infinity();
  const auto above = [&](double t) {
    const Vec3 p = a + t * (b - a);
    const double height = bottom.height(p.x(), p.y());
    if (height <= bottom.high(2)) most = std::max(most, p.z() - height);
    return p.z() - height;
  };
  double low = 0, high = 1;  // range of the part over or under the box around the shape
  for (int axis = 0; axis < 2; ++axis) {
    const double way = b[axis] - a[axis];
    double first = (bottom.low(axis) - a[axis]) / way, last = (bottom.high(axis) - a[axis]) / way;
    if (first > last) std::swap(first, last);
    if (std::abs(way) > 1e-12) low = std::max(low, first), high = std::min(high, last);
  }
  if (!(low <= high)) return most;
  constexpr double golden = 0.6180339887498949;
  double t1 = high - golden * (high - low), t2 = low + golden * (high - low), f1 = above(t1), f2 = above(t2);
  above(low), above(high);
  for (int i = 0; i < 36; ++i) {
    if (f1 > f2) {
      high = t2, t2 = t1, f2 = f1;
      t1 = high - golden * (high - low);
      f1 = above(t1);
    } else {
      low = t1, t1 = t2, f1 = f2;
      t2 = low + golden * (high - low);
      f2 = above(t2);
    }
  }
  return most;
}

}  // namespace

ConvexBottom::ConvexBottom(const Shape& shape, const Pose& at, std::span<const Vec3> corners)
    : shape_(shape), at_(at), corners_(3, corners.size()) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners_.col(Eigen::Index(i)) = at_ * Vec3(shape_.size.cwiseProduct(corners[i]));
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = furthest(-Vec3::Unit(axis))[axis];
    high_[axis] = furthest(Vec3::Unit(axis))[axis];
  }
}

Vec3 ConvexBottom::furthest(const Vec3& direction) const {
  if (corners_.cols() == 0) return at_ * furthest_in_shape(at_.orientation.conjugate() * direction);
  Eigen::Index best = 0;
  (direction.transpose() * corners_).maxCoeff(&best);
  return corners_.col(best);
}

Vec3 ConvexBottom::furthest_in_shape(const Vec3& d) const {
  const Vec3& size = shape_.size;
  const double end = std::copysign(0.5 * size.z(), d.z());
  switch (shape_.kind) {
    case ShapeKind::box:
      return {std::copysign(0.5 * size.x(), d.x()), std::copysign(0.5 * size.y(), d.y()), end};
    case ShapeKind::sphere:
      return size.x() * d;
    case ShapeKind::capsule:
      return size.x() * d + Vec3(0, 0, end);
    case ShapeKind::cylinder: {
      const double radial = elementary::hypot(d.x(), d.y());
      const double scale = radial > 1e-12 ? size.x() / radial : 0;
      return {scale * d.x(), scale * d.y(), end};
    }
    case ShapeKind::mesh:  // without corners it counts as a point
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      break;
  }
  return Vec3::Zero();
}

/// Height of the lower hull at a point, by a simplex method: three points of the shape form a triangle over it;
/// the point furthest below their plane replaces one, until there is none. The first three are high around the shape.
double ConvexBottom::height(double x, double y) const {
  const Vec3 q(x, y, 0), middle = 0.5 * (low_ + high_);
  const double far = 4 * (high_ - low_).norm() + hair, top = high_.z() + steepness * far;
  const Vec3 around[] = {{middle.x() + far, middle.y(), top},
                         {middle.x() - far, middle.y() + far, top},
                         {middle.x() - far, middle.y() - far, top}};
  Vec3 a = around[0], b = around[1], c = around[2];
  double found = top;
  for (int i = 0; i < 100; ++i) {
    const Vec3 normal = (b - a).cross(c - a);
    if (!(normal.z() > 1e-14 * normal.norm())) break;
    found = a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
    const Vec3 down = -normal.normalized();
    Vec3 next = furthest(down);
    for (const Vec3& p : around)
      if (down.dot(p - next) > 0) next = p;
    if (down.dot(next - a) < hair) break;
    const Vec3 to = next - q;
    const double of_a = cross(a - q, to), of_b = cross(b - q, to), of_c = cross(c - q, to);
    if (of_a <= 0 && of_b >= 0)
      c = next;
    else if (of_b <= 0 && of_c >= 0)
      a = b, b = c, c = next;
    else
      b = a, a = c, c = next;
  }
  return found;
}

/// The rise is the maximum of a function that is concave over each triangle. If the triangle's plane would touch the
/// shape within the triangle, the maximum is there; otherwise it is on an edge.
void RiseAbove::add(const Triangle& t) {
  const Vec3 across = (t[1] - t[0]).cross(t[2] - t[0]);
  if (!(across.z() > 1e-9 * across.norm())) return;
  for (int axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (low > bottom_.high(axis) || high < bottom_.low(axis)) return;
  }
  if (std::max({t[0].z(), t[1].z(), t[2].z()}) - bottom_.low(2) <= most_) return;
  const Vec3 normal = across.normalized(), touching = bottom_.furthest(-normal);
  const double by_plane = normal.dot(t[0] - touching) / normal.z();
  const double bound = std::min(by_plane, std::max({t[0].z(), t[1].z(), t[2].z()}) - bottom_.low(2));
  if (bound <= most_) return;
  bool is_inside = true;
  for (std::size_t i = 0; i < 3; ++i) is_inside = is_inside && cross(t[(i + 1) % 3] - t[i], touching - t[i]) >= 0;
  if (is_inside)
    most_ = by_plane;
  else
    bounds_.push_back({bound, t});
  if (bounds_.size() >= most_bounds) look_at_edges();
}

std::optional<double> RiseAbove::rise() {
  look_at_edges();
  if (!std::isfinite(most_)) return std::nullopt;
  return most_;
}

/// Checks the edges and corners of the triangles so far.
void RiseAbove::look_at_edges() {
  std::sort(bounds_.begin(), bounds_.end(), [](const Bound& a, const Bound& b) { return a.rise > b.rise; });
  for (const Bound& bound : bounds_) {  // on rough ground the first is a peak, and few triangles remain after it
    if (bound.rise <= most_ + hair) break;
    for (const Vec3& corner : bound.triangle) {
      if (corner.z() - bottom_.low(2) <= most_ || !bottom_.is_near(corner)) continue;
      const double height = bottom_.height(corner.x(), corner.y());
      if (height <= bottom_.high(2)) most_ = std::max(most_, corner.z() - height);
    }
  }
  for (const Bound& bound : bounds_) {
    if (bound.rise <= most_ + hair) break;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = bound.triangle[i], &b = bound.triangle[(i + 1) % 3];
      if (std::max(a.z(), b.z()) - bottom_.low(2) > most_) most_ = std::max(most_, highest_above(bottom_, a, b));
    }
  }
  bounds_.clear();
}

}  // namespace muro::host
