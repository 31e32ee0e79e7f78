// SPDX-License-Identifier: MIT
// Finds points of the field's lines: narrow pale ridges in the grass, along some columns and rows of a picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "player_finder.hpp"

namespace soccer {

class LineFinder {
 public:
  static constexpr std::size_t most = 16;
  using Points = LimitedList<Vector, most>;

  /// Returns points on the middles of lines on the ground in the heading frame (m). `ball`, `players`: objects that are
  /// seen and are no lines.
  Points find(const Image& image, const CameraView& view, const std::optional<Vector>& ball,
              std::span<const SeenPlayer> players) const {
    Candidates all;
    constexpr int spacing = 8;  // px
    const int top = std::max(0, int(std::ceil(view.horizon(0.5 * image.width()))) + 2);
    for (int u = spacing / 2; u < image.width(); u += spacing) {
      const Scan scan{{u + 0.5, top + 0.5}, 0, 1, image.height() - top};
      look_along(scan, image, view, all);
    }
    for (int v = image.height() - spacing / 2; v > top; v -= spacing)
      look_along({{0.5, v + 0.5}, 1, 0, image.width()}, image, view, all);
    const auto kept = all.all();
    const auto end = std::remove_if(kept.begin(), kept.end(), [&](const Vector& p) {
      return is_off(p, ball) || std::any_of(players.begin(), players.end(),
                                            [&](const SeenPlayer& player) { return hides(player, p, view); });
    });
    const std::size_t count = std::size_t(end - kept.begin()), told = std::min(most, count);
    Points points;
    for (std::size_t i = 0; i < told; ++i) points.add(kept[i * count / told]);
    return points;
  }

 private:
  using Candidates = LimitedList<Vector, 96>;
  static constexpr double farthest = 3.5;  ///< m
  static constexpr double nearest = 0.3;   ///< m
  static constexpr int contrast = 28;      ///< least brightness of a ridge above the grass on both sides, of 255
  static constexpr double widest = 0.25;   ///< m, greatest width on the ground, along the scan

  struct Scan {
    Pixel begin;  ///< the middle of its first pixel
    int du = 0, dv = 0, length = 0;
    Pixel at(double i) const { return {begin.u + i * du, begin.v + i * dv}; }
  };

  static void look_along(const Scan& scan, const Image& image, const CameraView& view, Candidates& all) {
    const auto column = [&](int i) { return int(scan.begin.u) + i * scan.du; };
    const auto row = [&](int i) { return int(scan.begin.v) + i * scan.dv; };
    const auto level = [&](int i) { return image.least(column(i), row(i)); };
    const auto is_grass = [&](int i) { return image.color(column(i), row(i)) == green; };
    int i = 1;
    while (i + 1 < scan.length) {
      // from grass up to a ridge
      if (!is_grass(i - 1) || level(i) < level(i - 1) + contrast / 2) {
        ++i;
        continue;
      }
      const int begin = i - 1;
      const int ground = level(begin);
      int end = i, top = 0;
      while (end < scan.length && (image.color(column(end), row(end)) == white || is_grass(end)) &&
             level(end) > ground + contrast / 2)
        top = std::max(top, level(end)), ++end;
      i = end + 1;
      if (end >= scan.length || !is_grass(end) || top < std::max(ground, level(end)) + contrast) continue;
      double weight = 0, sum = 0;
      for (int k = begin; k <= end; ++k) {
        const double above = std::max(0, level(k) - std::max(ground, level(end)));
        weight += above, sum += above * k;
      }
      const Pixel middle = scan.at(sum / weight);
      const double half = 0.5 * weight / (top - ground);  // px
      const auto point = view.at_height(middle, 0);
      const auto one = view.at_height({middle.u - half * scan.du, middle.v - half * scan.dv}, 0);
      const auto other = view.at_height({middle.u + half * scan.du, middle.v + half * scan.dv}, 0);
      if (!point || !one || !other) continue;
      const Vector across = *one - *other;
      if (dot(across, across) < widest * widest) all.add(*point);
    }
  }
  /// Returns whether a point is seen where a player is.
  static bool hides(const SeenPlayer& player, const Vector& point, const CameraView& view) {
    constexpr double half_width = 0.2, height = 0.5;  // m
    const auto feet = view.pixel_of(player.feet), p = view.pixel_of(point);
    if (!feet || !p) return false;
    const double depth = view.depth_of(player.feet), scale = view.lens().fx / depth;
    return std::abs(p->u - feet->u) < half_width * scale && p->v < feet->v + 0.08 * scale &&
           p->v > feet->v - height * scale;
  }
  static bool is_off(const Vector& point, const std::optional<Vector>& ball) {
    constexpr double near_ball = 0.15;  // m
    const double distance2 = point.x * point.x + point.y * point.y;
    if (distance2 > farthest * farthest || distance2 < nearest * nearest) return true;
    if (!ball) return false;
    const double x = point.x - ball->x, y = point.y - ball->y;
    return x * x + y * y < near_ball * near_ball;
  }
};

}  // namespace soccer
