// SPDX-License-Identifier: MIT
// Finds the colour of a target in a picture, and the place of the target around the robot: from the lens, from the pose
// of the camera on the robot, and from the height of a target.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "../common/angle.hpp"
#include "../common/place.hpp"
#include "../common/vector.hpp"

namespace mixed_team {

using examples::Point;

/// Connected pixels of the colour.
struct Blob {
  double u = 0, v = 0;  ///< px: their centre, columns and rows from the upper left corner
  int pixels = 0;
  bool is_cut = false;  ///< it reaches to the rim of the picture
};

/// A colour by its hue: 0 red, 1/6 yellow, 1/3 green. Only bright, saturated colours match.
struct Hue {
  double hue = 0, tolerance = 0;

  bool matches(double r, double g, double b) const {
    const double most = std::max({r, g, b}), least = std::min({r, g, b}), spread = most - least;
    if (most < 70 || 2 * spread < most) return false;
    const double sixth = most == r ? (g - b) / spread : most == g ? 2 + (b - r) / spread : 4 + (r - g) / spread;
    return std::abs(std::remainder(sixth / 6 - hue, 1)) < tolerance;
  }
};

/// Finds blobs. It keeps its memory for the next picture.
class BlobFinder {
 public:
  /// Returns blobs of `least` pixels or more. `rgb`: 0 to 255, rows from the top.
  std::span<const Blob> find(std::span<const double> rgb, int width, int height, const Hue& hue, int least) {
    blobs_.clear();
    open_.assign(std::size_t(width) * std::size_t(height), 0);
    stack_.reserve(open_.size());      // each pixel comes once
    blobs_.reserve(open_.size() / 2);  // blobs do not touch
    for (std::size_t i = 0; i < open_.size(); ++i)
      open_[i] = hue.matches(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]) ? 1 : 0;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i] == 0) continue;
      const Blob blob = fill(int(i), width, height);
      if (blob.pixels >= least) blobs_.push_back(blob);
    }
    return blobs_;
  }

 private:
  /// Returns all pixels that are connected with one along rows and columns.
  Blob fill(int start, int width, int height) {
    Blob blob;
    stack_.assign(1, start);
    open_[std::size_t(start)] = 0;
    while (!stack_.empty()) {
      const int i = stack_.back(), u = i % width, v = i / width;
      stack_.pop_back();
      ++blob.pixels, blob.u += u + 0.5, blob.v += v + 0.5;
      blob.is_cut = blob.is_cut || u == 0 || v == 0 || u == width - 1 || v == height - 1;
      const auto visit = [&](bool inside, int next) {
        if (inside && open_[std::size_t(next)] != 0) open_[std::size_t(next)] = 0, stack_.push_back(next);
      };
      visit(u > 0, i - 1), visit(u < width - 1, i + 1), visit(v > 0, i - width), visit(v < height - 1, i + width);
    }
    blob.u /= blob.pixels, blob.v /= blob.pixels;
    return blob;
  }

  std::vector<Blob> blobs_;
  std::vector<std::uint8_t> open_;  // 1: of the colour, and not yet in a blob
  std::vector<int> stack_;
};

/// A pinhole camera, px, and its pose: m in the frame of the base, rad downwards.
struct Camera {
  double fx = 1, fy = 1, cx = 0, cy = 0;
  double x = 0, z = 0, pitch = 0;

  /// Place seen at a pixel, m forward and left of the base, level, if it is `below` (m) the base's origin. Nothing for
  /// the sky, or for places farther than 20 times as far as down. `orientation` of the base: x, y, z, w.
  std::optional<Point> place(double u, double v, double below, std::span<const double> orientation) const {
    const double right = (u - cx) / fx, down = (v - cy) / fy;  // slopes of the ray against the axis
    const double c = muro_cos(pitch), s = muro_sin(pitch);
    const auto base = examples::Rotation::of(orientation);
    const auto ray = base * examples::Vector{c - s * down, -right, -s - c * down},
               at = base * examples::Vector{x, 0, z};
    if (ray.z > -0.05 * Point{ray.x, ray.y}.norm()) return std::nullopt;
    const double along = (-below - at.z) / ray.z;
    if (along <= 0) return std::nullopt;
    return turned(Point{at.x + along * ray.x, at.y + along * ray.y}, -examples::yaw_of(orientation));
  }
};

}  // namespace mixed_team
