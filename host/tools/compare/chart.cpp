// SPDX-License-Identifier: MIT
#include "host/tools/compare/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::host {

namespace {

constexpr double width = 760, height = 484, legend_height = 30;
constexpr double left = 84, right = 736, top = 72, bottom = 420;  // of the area of points
constexpr double strip = 34;                                      // for zeros, after a gap
constexpr double gap = 8;
constexpr double text_size = 13, character_width = 7.2;
constexpr double radius = 5.5;
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string text(double x, double y, const char* anchor, const std::string& what, const std::string& style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor,
                     style.empty() ? "" : " " + style, escaped(what));
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", kind, x1, y1, x2,
                     y2);
}

std::string tick_text(double value) {
  if (value >= 1e-4 && value < 1e5) return fmt::format("{:.6g}", value);
  return fmt::format("{:.0e}", value);
}

/// Converts values to coordinates: `from` is that of the smallest value, `to` that of the largest.
struct LogScale {
  double from, to;
  double low = 0, high = 1;  ///< decades
  bool zeros = false;        ///< whether there are values without a logarithm
  double zero = 0;           ///< their coordinate

  void fit(std::vector<double> values) {
    const std::size_t all = values.size();
    std::erase_if(values, [](double v) { return !(v > 0) || !std::isfinite(v); });
    zeros = values.size() < all;
    if (values.empty()) return;
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    low = elementary::log10(*min) - 0.12;
    high = elementary::log10(*max) + 0.12;
    const double missing = 1 - (high - low);
    if (missing > 0) low -= missing / 2, high += missing / 2;
  }
  double coordinate(double value) const {
    return value > 0 ? from + (elementary::log10(value) - low) / (high - low) * (to - from) : zero;
  }
  /// Returns the values with a tick; second: whether the tick has a number.
  std::vector<std::pair<double, bool>> ticks() const {
    std::vector<std::pair<double, bool>> all;
    for (int decade = int(std::floor(low)); decade <= int(std::ceil(high)); ++decade)
      for (int m = 1; m < 10; ++m) {
        const double exponent = decade + elementary::log10(m);
        if (exponent < low || exponent > high) continue;
        const bool labelled = m == 1 || (high - low < 2.5 && (m == 2 || m == 5));
        all.emplace_back(m * elementary::pow(10.0, decade), labelled);
      }
    return all;
  }
};

struct Box {
  double x1, y1, x2, y2;
  double overlap(const Box& b) const {
    return std::max(0.0, std::min(x2, b.x2) - std::max(x1, b.x1)) *
           std::max(0.0, std::min(y2, b.y2) - std::max(y1, b.y1));
  }
  double area() const { return (x2 - x1) * (y2 - y1); }
};

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {
    std::vector<double> xs, ys;
    for (const Chart::Point& p : chart.points) xs.push_back(p.x), ys.push_back(p.y);
    for (const Chart::Curve& c : chart.curves)
      for (const auto& [x, y] : c.points)
        if (!c.guide) xs.push_back(x), ys.push_back(y);
    x_.fit(xs);
    y_.fit(ys);
    if (x_.zeros) x_.from = left + strip + gap, x_.zero = left + strip / 2;
    if (y_.zeros) y_.from = bottom - strip - gap, y_.zero = bottom - strip / 2;
  }

  std::string all() {
    out_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" "
        "font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"{2:g}\" fill=\"#222\">\n"
        "<style>.grid{{stroke:#e4e4e4}}.fine{{stroke:#f4f4f4}}.tick{{stroke:#888}}.frame{{fill:none;stroke:#888}}"
        ".mark{{stroke:#b22;stroke-dasharray:5 4}}"
        ".lead{{stroke:#999;stroke-width:0.8}}.guide{{fill:none;stroke:#777;stroke-dasharray:6 4}}"
        ".curve{{fill:none;stroke-width:1.8}}.band{{fill:#d8d8d8;fill-opacity:0.6}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height + (chart_.groups.empty() ? 0 : legend_height), text_size);
    out_ += text(left, 30, "start", chart_.title, "font-size=\"17\" font-weight=\"bold\"");
    out_ += text(left, 52, "start", chart_.subtitle, "fill=\"#555\"");
    add_x_axis();
    add_y_axis();
    add_marks();
    add_clip();
    add_bands();
    add_curves();
    add_frames();
    add_points();
    add_legend();
    return out_ + "</svg>\n";
  }

 private:
  double inner_left() const { return x_.zeros ? left + strip + gap : left; }
  double inner_bottom() const { return y_.zeros ? bottom - strip - gap : bottom; }

  void add_x_axis() {
    for (const auto& [value, labelled] : x_.ticks()) {
      const double x = x_.coordinate(value);
      out_ += line(x, top, x, bottom, labelled ? "grid" : "fine");
      out_ += line(x, bottom, x, bottom + (labelled ? 6 : 3), "tick");
      if (labelled) out_ += text(x, bottom + 21, "middle", tick_text(value));
    }
    if (x_.zeros) out_ += text(x_.zero, bottom + 21, "middle", "0");
    out_ += text((left + right) / 2, bottom + 46, "middle", chart_.x.name + ", " + chart_.x.unit);
  }

  void add_y_axis() {
    for (const auto& [value, labelled] : y_.ticks()) {
      const double y = y_.coordinate(value);
      out_ += line(left, y, right, y, labelled ? "grid" : "fine");
      out_ += line(left - (labelled ? 6 : 3), y, left, y, "tick");
      if (labelled) out_ += text(left - 10, y + 4.5, "end", tick_text(value));
    }
    if (y_.zeros) out_ += text(left - 10, y_.zero + 4.5, "end", "0");
    const double middle = (top + bottom) / 2;
    out_ += text(22, middle, "middle", chart_.y.name + ", " + chart_.y.unit,
                 fmt::format("transform=\"rotate(-90 22 {:.1f})\"", middle));
  }

  void add_marks() {
    for (const Chart::Mark& m : chart_.marks) {
      const double x = x_.coordinate(m.x);
      if (!(x > inner_left() && x < right)) continue;
      out_ += line(x, top, x, bottom, "mark");
      out_ += text(x, top - 6, x > right - 60 ? "end" : "middle", m.text, "font-size=\"11\" fill=\"#b22\"");
    }
  }

  std::string place(double x, double y) const {
    return fmt::format("{:.1f},{:.1f} ", x_.coordinate(x), y_.coordinate(y));
  }

  /// Cuts off the following elements at the frame of the area.
  void begin_clip() { out_ += "<g clip-path=\"url(#area)\">\n"; }
  void add_clip() {
    if (chart_.bands.empty() && chart_.curves.empty()) return;
    out_ += fmt::format(
        "<clipPath id=\"area\"><rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/></clipPath>\n",
        inner_left(), top, right - inner_left(), inner_bottom() - top);
  }

  void add_bands() {
    if (chart_.bands.empty()) return;
    begin_clip();
    for (const Chart::Band& b : chart_.bands) {
      std::string corners;
      for (std::size_t i = 0; i < b.x.size(); ++i) corners += place(b.x[i], b.high[i]);
      for (std::size_t i = b.x.size(); i-- > 0;) corners += place(b.x[i], b.low[i]);
      out_ += fmt::format("<polygon class=\"band\" points=\"{}\"/>\n", corners);
    }
    out_ += "</g>\n";
  }

  void add_curves() {
    if (chart_.curves.empty()) return;
    begin_clip();
    for (const Chart::Curve& c : chart_.curves) {
      std::string corners;
      for (const auto& [x, y] : c.points) corners += place(x, y);
      const std::string style =
          c.guide ? "class=\"guide\""
                  : fmt::format("class=\"curve\" stroke=\"{}\"", colours[c.group % std::size(colours)]);
      out_ += fmt::format("<polyline {} points=\"{}\"/>\n", style, corners);
    }
    out_ += "</g>\n";
    for (const Chart::Curve& c : chart_.curves) add_curve_label(c);
  }

  /// Puts the label beside the first or last point within the area.
  void add_curve_label(const Chart::Curve& c) {
    if (c.label.empty()) return;
    const auto is_inside = [&](const std::pair<double, double>& p) {
      const double x = x_.coordinate(p.first), y = y_.coordinate(p.second);
      return x >= inner_left() && x <= right && y >= top + text_size && y <= inner_bottom() - 4;
    };
    const auto first = std::find_if(c.points.begin(), c.points.end(), is_inside);
    const auto last = std::find_if(c.points.rbegin(), c.points.rend(), is_inside);
    if (first == c.points.end()) return;
    const auto& [x, y] = c.label_first ? *first : *last;
    const double width_of_label = character_width * double(c.label.size());
    const bool falls = c.points.back().second < c.points.front().second;  // then there is space on its right
    const bool fits = x_.coordinate(x) + width_of_label + 8 < right;
    const bool begins = fits && (falls || c.label_first);
    out_ += text(x_.coordinate(x) + (begins ? 7 : -5), y_.coordinate(y) + (falls && !fits ? 14 : -5),
                 begins ? "start" : "end", c.label,
                 "font-size=\"12\" fill=\"#555\" paint-order=\"stroke\" stroke=\"white\" stroke-width=\"3\"");
  }

  /// Draws a frame for each part of the area: a broken axis has a gap between them.
  void add_frames() {
    const auto frame = [&](double x1, double y1, double x2, double y2) {
      out_ += fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", x1,
                          y1, x2 - x1, y2 - y1);
    };
    if (y_.zeros) cover(left - 1, bottom - strip - gap, right + 1, bottom - strip);
    if (x_.zeros) cover(left + strip, top - 1, left + strip + gap, bottom + 1);
    for (const bool low_x : {false, true})
      for (const bool low_y : {false, true}) {
        if ((low_x && !x_.zeros) || (low_y && !y_.zeros)) continue;
        frame(low_x ? left : inner_left(), low_y ? bottom - strip : top, low_x ? left + strip : right,
              low_y ? bottom : inner_bottom());
      }
  }
  void cover(double x1, double y1, double x2, double y2) {
    out_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"white\"/>\n", x1, y1,
                        x2 - x1, y2 - y1);
  }

  void add_points() {
    for (const Chart::Point& p : chart_.points) {
      const double x = x_.coordinate(p.x), y = y_.coordinate(p.y);
      occupied_.push_back({x - radius, y - radius, x + radius, y + radius});
    }
    for (std::size_t i = 0; i < chart_.points.size(); ++i) add_label(i);
    for (const Chart::Point& p : chart_.points) {
      const char* colour = colours[p.group % std::size(colours)];
      out_ +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.8\"/>\n",
                      x_.coordinate(p.x), y_.coordinate(p.y), radius, p.hollow ? "white" : colour, colour);
    }
  }

  /// Puts a label beside its point, or farther away with a line to it, where it overlaps points and other labels least.
  void add_label(std::size_t i) {
    const Chart::Point& p = chart_.points[i];
    const double x = x_.coordinate(p.x), y = y_.coordinate(p.y), w = character_width * double(p.label.size());
    Box best{};
    double min_cost = 1e300, label_distance = 0, side = 0;
    int candidates = 0;
    for (const double distance : {9.0, 22.0, 36.0, 52.0, 70.0, 90.0})
      for (const double angle : {0.0, 180.0, -90.0, 90.0, -45.0, 45.0, -135.0, 135.0, -20.0, 20.0, -160.0, 160.0}) {
        const double dx = elementary::cos(angle * M_PI / 180), dy = elementary::sin(angle * M_PI / 180);
        const double cx = x + dx * (distance + w / 2), cy = y + dy * (distance + text_size / 2 - (dx == 0 ? 0 : 2));
        const Box box{cx - w / 2, cy - text_size / 2, cx + w / 2, cy + text_size / 2};
        const Box area{left + 2, top + 2, right - 2, bottom - 2};
        double cost = 0.5 * candidates++ + 20 * (box.area() - box.overlap(area));
        for (const Box& t : occupied_) cost += 10 * box.overlap(t);
        if (cost < min_cost) min_cost = cost, best = box, label_distance = distance, side = dx;
      }
    occupied_.push_back(best);
    if (label_distance > 10)
      out_ += line(x, y, std::clamp(x, best.x1, best.x2), std::clamp(y, best.y1, best.y2), "lead");
    const bool beside = std::abs(side) > 0.1;  // then the text begins or ends at the point, with any length
    out_ += text(!beside ? (best.x1 + best.x2) / 2 : (side > 0 ? best.x1 : best.x2), best.y2 - 2.5,
                 !beside ? "middle" : (side > 0 ? "start" : "end"), p.label,
                 "paint-order=\"stroke\" stroke=\"white\" stroke-width=\"3\"");
  }

  void add_legend() {
    double x = left;
    for (std::size_t i = 0; i < chart_.groups.size(); ++i) {
      out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", x + radius, height + 6.5,
                          radius, colours[i % std::size(colours)]);
      out_ += text(x + 18, height + 11, "start", chart_.groups[i]);
      x += 46 + character_width * double(chart_.groups[i].size());
    }
  }

  const Chart& chart_;
  LogScale x_{.from = left, .to = right};
  LogScale y_{.from = bottom, .to = top};
  std::vector<Box> occupied_;  ///< areas of points and labels
  std::string out_;
};

}  // namespace

std::string svg(const Chart& chart) { return Drawing(chart).all(); }

}  // namespace muro::host
