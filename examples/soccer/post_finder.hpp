// SPDX-License-Identifier: MIT
// Finds the posts of goals: upright white stripes that stand on the ground and are as wide as a post at the place of
// their feet.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "../common/limited_list.hpp"
#include "camera_view.hpp"
#include "image.hpp"

namespace soccer {

using examples::LimitedList;

class PostFinder {
 public:
  using Posts = LimitedList<Vector, 2>;

  /// `radius`: m, radius of a post.
  explicit PostFinder(double radius) : radius_(radius) {}

  /// Returns the axes of posts on the ground in the heading frame (m); the left one first.
  Posts find(const Image& image, const CameraView& view) const {
    LimitedList<Vector, 8> seen;
    constexpr int row_step = 3;
    const int last = std::min(image.height() - 1, int(view.horizon(0.5 * image.width())) + 15);
    look_along(0, image, view, seen);
    for (int row = row_step; row <= last; row += row_step) look_along(row, image, view, seen);
    return nearest_two(seen);
  }

 private:
  static constexpr double farthest = 7;  ///< m

  struct Stripe {
    double left = 0, right = 0;  ///< px
    double width() const { return right - left; }
    double middle() const { return 0.5 * (left + right); }
  };

  void look_along(int row, const Image& image, const CameraView& view, LimitedList<Vector, 8>& seen) const {
    for (int u = 0; u < image.width(); ++u) {
      if (image.color(u, row) != white) continue;
      int end = u;
      while (end < image.width() && image.color(end, row) == white) ++end;
      if (u > 0 && end < image.width()) {
        if (const auto foot = follow_down({double(u), double(end)}, row, image, view)) add(*foot, seen);
      }
      u = end;
    }
  }
  static void add(const Vector& foot, LimitedList<Vector, 8>& seen) {
    for (const Vector& other : seen.all())
      if (std::abs(foot.x - other.x) + std::abs(foot.y - other.y) < 0.5) return;
    seen.add(foot);
  }

  /// Returns where a stripe that is seen in a row stands on the ground.
  std::optional<Vector> follow_down(Stripe stripe, int row, const Image& image, const CameraView& view) const {
    double u = stripe.middle(), widths = 0, drift = 0;
    int rows = 0, free_rows = 0;  // free: bounded on both sides by another colour than white
    for (;; ++row, ++rows) {
      if (row >= image.height()) return std::nullopt;  // its foot is below the picture
      const auto here = stripe_at(u, row, image);
      const double part = 0.2 * stripe.width();
      if (!here || here->left > u - part || here->right < u + part) break;
      const double change = here->width() - stripe.width();
      if (here->left > 0 && here->right < image.width() && std::abs(change) < 1 + 0.1 * stripe.width()) {
        const double off = 0.5 * (here->middle() - u);
        stripe.right += 0.3 * change;
        widths += here->width(), ++free_rows, drift += off, u += off;
      }
      const Pixel up = view.upright_at({u, row + 0.5});
      u += up.u / up.v;
    }
    constexpr double leans = 0.08;  // share of its height
    if (free_rows < 4 || 3 * free_rows < rows || std::abs(drift) > leans * free_rows + 1) return std::nullopt;
    if (!is_on_ground(u, row + 1, stripe.width(), image)) return std::nullopt;
    const double bottom = bottom_of(u, row, image);
    const Pixel up = view.upright_at({u, bottom});
    const auto front = view.at_height({u, bottom}, 0);
    if (!front) return std::nullopt;
    const double distance = std::sqrt(front->x * front->x + front->y * front->y), depth = view.depth_of(*front);
    if (distance > farthest || depth < 0.2) return std::nullopt;
    const double slant = std::sqrt(up.u * up.u + up.v * up.v) / -up.v;  // length for each row
    const double width = widths / free_rows / slant, expected = 2 * radius_ * view.lens().fx / depth;
    // tubes and the net behind a goal are narrower; beside a post they make it look wider
    if (width < 0.97 * expected - 0.4 || width > 1.4 * expected + 1.2) return std::nullopt;
    constexpr double least_height = 0.25;  // m: lines and shoes are lower
    if (rows < least_height * -up.v / depth) return std::nullopt;
    return (1 + radius_ / distance) * Vector{front->x, front->y, 0};
  }

  /// Returns whether there is grass below, or a line with grass beside it.
  static bool is_on_ground(double u, int row, double width, const Image& image) {
    const auto below = image.at(u, row), left = image.at(u - width, row), right = image.at(u + width, row);
    const auto is = [](const std::optional<Color>& color, Color c) { return !color || *color == c; };
    const auto is_ground = [&](const std::optional<Color>& color) { return is(color, green) || is(color, white); };
    return is(below, green) ||
           (is(below, white) && is_ground(left) && is_ground(right) && (is(left, green) || is(right, green)));
  }
  /// Returns the bottom in px, between the last white row and the next one, by the whiteness of the rows.
  static double bottom_of(double u, int row, const Image& image) {
    const int column = int(std::floor(u));
    if (column < 0 || column >= image.width() || row < 3 || row + 1 >= image.height()) return row;
    const double post = image.least(column, row - 3), grass = image.least(column, row + 1);
    if (post <= grass) return row;
    constexpr double bleeding = 0.2;  // px: of white into grass
    double bottom = row - 2 - bleeding;
    for (int v = row - 2; v <= row; ++v)
      bottom += std::clamp((image.least(column, v) - grass) / (post - grass), 0.0, 1.0);
    return bottom;
  }
  /// Returns the white run about (u, row).
  static std::optional<Stripe> stripe_at(double u, int row, const Image& image) {
    const int middle = int(std::floor(u));
    if (middle < 0 || middle >= image.width() || image.color(middle, row) != white) return std::nullopt;
    int left = middle, right = middle + 1;
    while (left > 0 && image.color(left - 1, row) == white) --left;
    while (right < image.width() && image.color(right, row) == white) ++right;
    return Stripe{double(left), double(right)};
  }

  static Posts nearest_two(LimitedList<Vector, 8>& seen) {
    const auto all = seen.all();
    std::sort(all.begin(), all.end(), [](const Vector& a, const Vector& b) { return dot(a, a) < dot(b, b); });
    Posts posts;
    constexpr double apart = 1.2;  // m: nearer stripes belong to the frame of the same goal
    for (const Vector& foot : all) {
      const auto known = posts.all();
      const bool is_frame = std::any_of(known.begin(), known.end(), [&](const Vector& other) {
        const Vector d = foot - other;
        return dot(d, d) < apart * apart;
      });
      if (!is_frame) posts.add(foot);
    }
    const auto kept = posts.all();
    // the left one is counterclockwise of the right one
    if (kept.size() == 2 && kept[0].x * kept[1].y - kept[0].y * kept[1].x > 0) std::swap(kept[0], kept[1]);
    return posts;
  }

  double radius_;  ///< m
};

}  // namespace soccer
