// SPDX-License-Identifier: MIT
// A picture of the field as kinds of colours. For the kinds that fill areas (grass, white and dark) it gives sums over
// rectangles in constant time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace soccer {

/// Kinds of colours.
enum Color : std::uint8_t { green, white, dark, blue, red, sky, other };

inline Color color_of(int r, int g, int b) {
  if (5 * g > 6 * r && 5 * g > 6 * b) return green;
  const int most = std::max({r, g, b}), least = std::min({r, g, b});
  if (b > 60 && 3 * b > 4 * g && b > 2 * r) return blue;
  if (r > 60 && r > 2 * g && r > 2 * b) return red;
  if (most < 90) return dark;
  if (least < 106 || most - least > 59) return other;
  return b - r > 26 ? sky : white;
}

class Image {
 public:
  /// `rgb`: red, green, blue; rows from the top.
  void set(std::span<const std::uint8_t> rgb, int width, int height) {
    width_ = width, height_ = height;
    colors_.resize(std::size_t(width) * std::size_t(height));
    least_.resize(colors_.size());
    for (std::vector<std::int32_t>& sums : sums_) sums.assign(std::size_t(width + 1) * std::size_t(height + 1), 0);
    for (int v = 0; v < height; ++v) {
      std::array<std::int32_t, summed> row{};
      for (int u = 0; u < width; ++u) {
        const std::uint8_t* const p = rgb.data() + 3 * (std::size_t(v) * std::size_t(width) + std::size_t(u));
        const Color color = color_of(p[0], p[1], p[2]);
        colors_[std::size_t(v) * std::size_t(width) + std::size_t(u)] = color;
        least_[std::size_t(v) * std::size_t(width) + std::size_t(u)] = std::min({p[0], p[1], p[2]});
        if (color < summed) ++row[color];
        for (int c = 0; c < summed; ++c)
          sums_[std::size_t(c)][corner(u + 1, v + 1)] = sums_[std::size_t(c)][corner(u + 1, v)] + row[std::size_t(c)];
      }
    }
  }
  /// Returns the colour at a point; nothing outside the picture.
  std::optional<Color> at(double u, double v) const {
    const int column = int(std::floor(u)), row = int(std::floor(v));
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return std::nullopt;
    return colors_[std::size_t(row) * std::size_t(width_) + std::size_t(column)];
  }
  /// Returns the colour of a pixel in the picture.
  Color color(int column, int row) const { return colors_[index(column, row)]; }
  /// Returns the least of red, green and blue, 0 to 255, of a pixel in the picture: its whiteness among grass.
  int least(int column, int row) const { return least_[index(column, row)]; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// Number of pixels of green, white or dark in the part of a rectangle that is in the picture.
  struct Count {
    int counted = 0, all = 0;
    double part() const { return all > 0 ? double(counted) / all : 0; }
  };
  Count count(Color color, double left, double top, double right, double bottom) const {
    const int l = std::clamp(nearest(left), 0, width_), r = std::clamp(nearest(right), 0, width_);
    const int t = std::clamp(nearest(top), 0, height_), b = std::clamp(nearest(bottom), 0, height_);
    if (l >= r || t >= b) return {};
    const std::vector<std::int32_t>& s = sums_[color];
    return {s[corner(r, b)] - s[corner(l, b)] - s[corner(r, t)] + s[corner(l, t)], (r - l) * (b - t)};
  }

 private:
  static constexpr int summed = 3;  ///< number of colours with sums

  static int nearest(double x) { return int(std::floor(x + 0.5)); }
  std::size_t index(int u, int v) const { return std::size_t(v) * std::size_t(width_) + std::size_t(u); }
  std::size_t corner(int u, int v) const { return std::size_t(v) * std::size_t(width_ + 1) + std::size_t(u); }

  int width_ = 0, height_ = 0;
  std::vector<Color> colors_;
  std::vector<std::uint8_t> least_;
  std::array<std::vector<std::int32_t>, summed> sums_;  ///< sums over all pixels above and to the left
};

}  // namespace soccer
