// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>

#include "host/tools/identify/identification.hpp"

namespace muro::host {

namespace {

constexpr double panel_width = 300, panel_height = 120, left_margin = 52, top_margin = 44, gap_x = 26, gap_y = 34;
constexpr std::size_t columns = 3;

std::string without_markup(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>')
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : "&gt;";
    else if (c >= ' ')
      out += c;
  }
  return out;
}

/// Returns 1, 2 or 5 times a power of ten, at least `x`.
double round_up(double x) {
  double unit = 1e-6;
  for (; unit < 1e6; unit *= 10)
    for (const double m : {1.0, 2.0, 5.0})
      if (m * unit >= x) return m * unit;
  return unit;
}

std::string panel(const PredictedRecord& r, double x, double y, double most) {
  const std::vector<double>&t = r.residuals.times, &e = r.residuals.errors;
  const double begin = t.empty() ? 0 : t.front(), span = t.empty() ? 1 : std::max(t.back() - begin, 1e-9);
  const double middle = y + 0.5 * panel_height;
  std::string out = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" class=\"frame\"/>\n<line x1=\"{:.1f}\" y1=\"{:.1f}\" "
      "x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"zero\"/>\n",
      x, y, panel_width, panel_height, x, middle, x + panel_width, middle);
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}, P {:g}{}: {:.4f} rad</text>\n", x, y - 5,
                     without_markup(std::filesystem::path(r.record.name).filename().string()), r.record.p_gain,
                     r.is_validation ? ", left out" : "", r.error.mean);
  out += fmt::format("<polyline class=\"{}\" points=\"", r.is_validation ? "out" : "fit");
  const std::size_t every = std::max<std::size_t>(1, e.size() / 600);
  for (std::size_t i = 0; i < e.size(); i += every)
    out += fmt::format("{:.1f},{:.1f} ", x + panel_width * (t[i] - begin) / span,
                       middle - 0.5 * panel_height * std::clamp(e[i] / most, -1.0, 1.0));
  out += "\"/>\n";
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n", x - 4, y + 9, most);
  out +=
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n", x - 4, y + panel_height, -most);
  return out + fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.3g} s</text>\n", x + panel_width,
                           y + panel_height + 12, span);
}

}  // namespace

std::string residual_plot(const Identification& id, const std::string& by) {
  double most = 0;
  for (const PredictedRecord& r : id.records)
    if (std::isfinite(r.error.largest)) most = std::max(most, r.error.largest);
  most = round_up(std::max(most, 1e-6));
  const std::size_t rows = (id.records.size() + columns - 1) / columns;
  const double width = left_margin + double(columns) * (panel_width + gap_x + 20);
  const double height = top_margin + double(rows) * (panel_height + gap_y) + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<style>.frame{{fill:none;stroke:#999}}.zero{{stroke:#ccc}}"
      ".fit{{fill:none;stroke:#0072b2}}.out{{fill:none;stroke:#d55e00}}</style>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n<text x=\"12\" y=\"17\" font-size=\"13\">Simulated minus recorded position, rad, by {2} "
      "(orange: left out of the fit)</text>\n",
      width, height, by.empty() ? name_of(id.settings.friction) : without_markup(by));
  for (std::size_t i = 0; i < id.records.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    svg += panel(id.records[i], left_margin + double(column) * (panel_width + gap_x + 20),
                 top_margin + double(row) * (panel_height + gap_y), most);
  }
  return svg + "</svg>\n";
}

}  // namespace muro::host
