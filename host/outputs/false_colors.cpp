// SPDX-License-Identifier: MIT
#include "host/outputs/false_colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "muro/base/elementary.hpp"

namespace muro::host {

namespace {

using Color = std::array<double, 3>;

/// A colour map from dark blue to bright yellow with rising lightness; `x` is in 0..1.
Color color_map(double x) {
  constexpr Color stops[] = {{40, 15, 90}, {60, 80, 150}, {35, 145, 140}, {95, 200, 100}, {250, 230, 40}};
  const double at = (x > 0 ? std::min(x, 1.0) : 0) * (std::size(stops) - 1);
  const auto first = std::min(std::size_t(at), std::size(stops) - 2);
  Color c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = stops[first][k] + (at - double(first)) * (stops[first + 1][k] - stops[first][k]);
  return c;
}

void put(std::vector<std::uint8_t>& rgb, const Color& c) {
  for (const double v : c) rgb.push_back(std::uint8_t(std::lround(v)));
}

}  // namespace

std::vector<std::uint8_t> colors_of(std::span<const float> depth) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const float d : depth)
    if (std::isfinite(d)) low = std::min(low, double(d)), high = std::max(high, double(d));
  std::vector<std::uint8_t> rgb;
  for (const float d : depth)
    put(rgb, std::isfinite(d)
                 ? color_map(high > low ? elementary::log(double(d) / low) / elementary::log(high / low) : 0)
                 : Color{});
  return rgb;
}

std::vector<std::uint8_t> colors_of(std::span<const ObjectId> labels) {
  std::vector<std::uint8_t> rgb;
  for (const ObjectId label : labels) {
    // hues at steps of the golden angle are easy to tell apart
    const double hue = 6 * std::fmod(0.618033988749895 * index_of(label), 1.0), rest = hue - std::floor(hue);
    const int sector = int(hue);
    const double up = 90 + 140 * rest, down = 230 - 140 * rest;
    const Color colors[] = {{230, up, 90},   {down, 230, 90}, {90, 230, up},
                            {90, down, 230}, {up, 90, 230},   {230, 90, down}};
    put(rgb, label == no_object ? Color{} : colors[std::min(sector, 5)]);
  }
  return rgb;
}

}  // namespace muro::host
