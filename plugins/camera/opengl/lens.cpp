// SPDX-License-Identifier: MIT
#include "lens.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "muro/algorithm.hpp"

namespace muro::camera {

Eigen::Vector2d Distortion::distorted(const Eigen::Vector2d& p) const {
  const double x = p.x(), y = p.y(), r2 = p.squaredNorm(), radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Vector2d Distortion::undistorted(const Eigen::Vector2d& target) const {
  constexpr int max_iterations = 30;
  constexpr double max_error = 1e-12, step = 1e-6;
  Eigen::Vector2d p = target;
  for (int i = 0; i < max_iterations; ++i) {
    const Eigen::Vector2d error = distorted(p) - target;
    if (error.norm() < max_error) return p;
    const Eigen::Vector2d dx(step, 0), dy(0, step);
    Eigen::Matrix2d jacobian;
    jacobian.col(0) = (distorted(p + dx) - distorted(p - dx)) / (2 * step);
    jacobian.col(1) = (distorted(p + dy) - distorted(p - dy)) / (2 * step);
    if (jacobian.determinant() <= 1e-6) break;  // here the lens folds the picture over
    p -= jacobian.inverse() * error;
  }
  const bool found = (distorted(p) - target).norm() < 1e-7;
  return found ? p : Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

LensMap LensMap::of(const render::Camera& camera, const Distortion& lens, std::uint32_t max_pixels) {
  LensMap map;
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (std::uint32_t row = 0; row < camera.height; ++row)
    for (std::uint32_t column = 0; column < camera.width; ++column) {
      const Eigen::Vector2d at((column + 0.5 - camera.cx) / camera.fx, (row + 0.5 - camera.cy) / camera.fy);
      points.push_back(lens.undistorted(at));
      if (!points.back().allFinite()) continue;
      low = low.cwiseMin(points.back());
      high = high.cwiseMax(points.back());
    }
  render::Camera& p = map.pinhole = camera;
  constexpr double margin = 2;  // pixels
  p.cx = margin - low.x() * p.fx;
  p.cy = margin - low.y() * p.fy;
  const double width = (high.x() - low.x()) * p.fx + 2 * margin, height = (high.y() - low.y()) * p.fy + 2 * margin;
  if (!(width >= 1 && height >= 1 && width <= max_pixels && height <= max_pixels))
    throw Error("distortion: the lens bends rays so far that a pinhole's picture of " + std::to_string(width) + " x " +
                std::to_string(height) + " pixels would be needed; at most " + std::to_string(max_pixels) +
                " either way are possible. The coefficients are k1, k2, p1, p2, k3");
  p.width = std::uint32_t(std::ceil(width));
  p.height = std::uint32_t(std::ceil(height));
  for (const Eigen::Vector2d& at : points) {
    Position place;
    if (at.allFinite()) place = {float(p.cx + p.fx * at.x() - 0.5), float(p.cy + p.fy * at.y() - 0.5)};
    map.positions.push_back(place);
  }
  return map;
}

}  // namespace muro::camera
