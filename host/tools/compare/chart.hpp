// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace muro::host {

/// A chart of labelled points and curves with logarithmic axes. Values of 0 and less have no logarithm; they are drawn
/// in a separate strip with the mark 0.
struct Chart {
  struct Axis {
    std::string name, unit;
  };
  struct Point {
    std::string label;
    double x = 0, y = 0;
    std::size_t group = 0;  ///< index in `groups`; decides the colour
    bool hollow = false;
  };

  /// A labelled vertical line at a value of x, drawn if it lies within the axis.
  struct Mark {
    double x;
    std::string text;
  };

  /// A line through points of positive values, cut off at the area.
  struct Curve {
    std::string label;
    std::vector<std::pair<double, double>> points;
    std::size_t group = 0;     ///< index in `groups`; decides the colour
    bool guide = false;        ///< dashed and grey; the axes are not chosen to show it
    bool label_first = false;  ///< the label is where the curve enters the area, otherwise where it leaves it
  };
  /// The area between two curves of the same x, shaded.
  struct Band {
    std::vector<double> x, low, high;
  };

  std::string title, subtitle;
  Axis x, y;
  std::vector<Point> points;
  std::vector<Mark> marks;
  std::vector<std::string> groups;  ///< for the legend; empty: no legend
  std::vector<Curve> curves{};
  std::vector<Band> bands{};
};

/// Returns the chart as an SVG file, 760 units wide. Labels are placed so that they overlap points and other labels as
/// little as possible.
std::string svg(const Chart& chart);

}  // namespace muro::host
