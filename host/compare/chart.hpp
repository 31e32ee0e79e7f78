// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace muro::host {

/// A chart of labelled points with logarithmic axes. Values of 0 and less, which such an axis has no place for, stand
/// in a strip of their own, marked 0.
struct Chart {
  struct Axis {
    std::string name, unit;
  };
  struct Point {
    std::string label;
    double x = 0, y = 0;
    std::size_t group = 0;  ///< its colour
    bool hollow = false;
  };

  /// A line across at a value of x that matters, if there is room for it.
  struct Mark {
    double x;
    std::string text;
  };

  std::string title, subtitle;
  Axis x, y;
  std::vector<Point> points;
  std::vector<Mark> marks;
  std::vector<std::string> groups;  ///< for the legend; none: no legend
};

/// As an SVG file, 760 wide. Labels lie where they cover neither points nor each other, as far as there is room.
std::string svg(const Chart& chart);

}  // namespace muro::host
