// SPDX-License-Identifier: MIT
// Finds a ball, white with dark patches, on a green field by its colours and its size. The size follows from the place
// of the ball in the picture, since it lies on the ground.
#pragma once

#include <optional>

#include "camera_view.hpp"
#include "image.hpp"

namespace soccer {

class BallFinder {
 public:
  explicit BallFinder(double radius) : radius_(radius) {}

  /// Returns the ball's centre in the heading frame (m), or nothing when no ball is seen.
  std::optional<Vector> find(const Image& image, const CameraView& view) const {
    Candidate best;
    for (double v = 1; v < image.height(); v += 2)
      for (double u = 1; u < image.width(); u += 2) {
        const double size = size_at({u, v}, view);
        if (size < least_size) continue;
        const double score = score_of(image, {u, v}, size);
        if (score > best.score) best = {{u, v}, size, score};
      }
    if (best.score <= 0) return std::nullopt;
    return view.at_height(centre(image, best, view), radius_);
  }

 private:
  static constexpr double least_size = 2;  ///< px, least radius
  static constexpr int points = 16;        ///< points on a circle about a candidate

  struct Candidate {
    Pixel at;
    double size = 0, score = 0;
  };

  /// Returns the radius in px of a ball whose centre is seen at a pixel; 0 when no ball can be there.
  double size_at(const Pixel& p, const CameraView& view) const {
    const auto centre = view.at_height(p, radius_);
    return centre ? view.lens().fx * radius_ / view.depth_of(*centre) : 0;
  }

  /// Returns more than 0 when a pixel looks like the centre of a ball: white and dark inside, green around it.
  static double score_of(const Image& image, const Pixel& p, double size) {
    const auto count = [&](Color c, double l, double t, double r, double b) {
      return image.count(c, p.u + l * size, p.v + t * size, p.u + r * size, p.v + b * size);
    };
    constexpr double in = 0.65;  // half the side of the square in a circle
    const Image::Count grass = count(green, -in, -in, in, in);
    if (grass.all < 4 || grass.part() > 0.1) return 0;
    const double whites = count(white, -in, -in, in, in).part(), darks = count(dark, -in, -in, in, in).part();
    const bool shows_patches = size > 3.5;
    if (whites < 0.3 || whites + darks < 0.7 || (shows_patches && (darks < 0.04 || darks > 0.65))) return 0;
    // a line crosses at most one side; upright objects continue above, parts of the robot itself below
    const Image::Count above = count(green, -0.7, -1.7, 0.7, -1.15), below = count(green, -0.7, 1.2, 0.7, 1.7);
    double sum = 0;
    int seen = 0, bare = 0;
    for (const Image::Count& side :
         {count(green, -1.7, -0.8, -1.15, 0.6), count(green, 1.15, -0.8, 1.7, 0.6), above, below}) {
      if (side.all == 0) continue;
      ++seen, sum += side.part(), bare += side.part() < 0.45;
    }
    if (!shows_patches && is_crossed(image, p, 1.35 * size)) return 0;  // it may be a piece of a line
    if (seen < 2 || bare > 1 || longest_gap(image, p, 1.35 * size) > 4 || (above.all > 0 && above.part() < 0.3) ||
        (below.all > 0 && below.part() < 0.3))
      return 0;
    if (is_of_player(image, p, 1.1 * size)) return 0;
    return whites + darks + sum / seen + 0.02 * size;
  }

  /// Returns whether the colours of a team are within a circle.
  static bool is_of_player(const Image& image, const Pixel& p, double radius) {
    for (double v = -radius; v <= radius; ++v)
      for (double u = -radius; u <= radius; ++u) {
        if (u * u + v * v > radius * radius) continue;
        const auto color = image.at(p.u + u, p.v + v);
        if (color && (*color == blue || *color == red)) return true;
      }
    return false;
  }

  /// Returns the colour at a point of a circle, `k` sixteenths of a turn on.
  static std::optional<Color> at_circle(const Image& image, const Pixel& p, double radius, int k) {
    constexpr double cosines[] = {1, 0.92388, 0.70711, 0.38268, 0};
    const auto cosine = [&](int i) {
      i %= points;
      if (i > points / 2) i = points - i;
      return i <= 4 ? cosines[i] : -cosines[8 - i];
    };
    return image.at(p.u + radius * cosine(k), p.v + radius * cosine(k + 12));
  }
  /// Returns whether something white crosses a circle from one side to the other.
  static bool is_crossed(const Image& image, const Pixel& p, double radius) {
    for (int k = 0; k < points / 2; ++k)
      if (at_circle(image, p, radius, k) == white && at_circle(image, p, radius, k + points / 2) == white) return true;
    return false;
  }
  /// Returns the length of the longest row of points on a circle that are not green. Points outside the picture count
  /// as not green: at its edge, too little of a ball is visible.
  static int longest_gap(const Image& image, const Pixel& p, double radius) {
    int longest = 0, row = 0;
    for (int k = 0; k < 2 * points; ++k) {
      row = at_circle(image, p, radius, k) == green ? 0 : row + 1;
      longest = std::max(longest, std::min(row, points));
    }
    return longest;
  }

  /// Returns the middle of the pixels about a candidate that are not green, or the candidate if their area is wrong.
  Pixel centre(const Image& image, const Candidate& c, const CameraView& view) const {
    const double reach = 1.2 * c.size;
    double weight = 0, u = 0, v = 0;
    for (double dv = -reach; dv <= reach; ++dv)
      for (double du = -reach; du <= reach; ++du) {
        if (du * du + dv * dv > reach * reach) continue;
        const Pixel p{std::floor(c.at.u + du), std::floor(c.at.v + dv)};
        const auto color = image.at(p.u, p.v);
        if (!color || *color == green) continue;
        ++weight, u += p.u + 0.5, v += p.v + 0.5;
      }
    const double circle = 3.14159265358979 * c.size * c.size;
    if (weight < 0.6 * circle || weight > 1.4 * circle) return c.at;
    const Pixel middle{u / weight, v / weight};
    return view.at_height(middle, radius_) ? middle : c.at;
  }

  double radius_;  ///< m
};

}  // namespace soccer
