// SPDX-License-Identifier: MIT
#include "host/tools/sensors/allan_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "host/names.hpp"
#include "host/tools/compare/chart.hpp"

namespace muro::host {

namespace {

constexpr double deviations_in_band = 2;  ///< 95 % of the estimates are within

/// Expected deviation of a component; 95 % of the estimates should be between `low` and `high`.
struct ExpectedBand {
  double expected, low, high;
};

ExpectedBand band_of(const AllanCurves& c, std::size_t component, const AllanPoint& p) {
  const double expected = c.reading.figures[component].deviation(p.cluster, c.reading.rate.period());
  const double error = deviations_in_band * allan_error(c.samples, p.cluster);
  return {expected, expected * std::max(0.0, 1 - error), expected * (1 + error)};
}

bool is_expected(const AllanCurves& c) {
  return std::all_of(c.reading.figures.begin(), c.reading.figures.end(),
                     [](const NoiseFigures& f) { return f.is_known(); });
}

/// Components with the same figures are described once.
bool same_figures(const AllanCurves& c) {
  const auto text = [](const NoiseFigures& f) {
    return fmt::format("{} {} {} {} {} {}", f.noise_density, f.bias_instability, f.random_walk, f.gauss_markov_sigma,
                       f.gauss_markov_time, f.resolution);
  };
  return std::all_of(c.reading.figures.begin(), c.reading.figures.end(),
                     [&](const NoiseFigures& f) { return text(f) == text(c.reading.figures.front()); });
}

std::string figures_text(const NoiseFigures& f, const std::string& unit) {
  std::vector<std::string> parts;
  const auto add = [&](double value, const char* what, const std::string& in) {
    if (value > 0) parts.push_back(fmt::format("{} {:.4g} {}", what, value, in));
  };
  add(f.noise_density, "N", unit + "/sqrt(Hz)");
  add(f.bias_instability, "B", unit);
  add(f.random_walk, "K", unit + "/s/sqrt(Hz)");
  if (f.gauss_markov_sigma > 0)
    parts.push_back(fmt::format("Gauss-Markov {:.4g} {} in {:g} s", f.gauss_markov_sigma, unit, f.gauss_markov_time));
  add(f.resolution, "resolution", unit);
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string heading(const std::string& label) { return label.empty() ? "deviation" : label; }

}  // namespace

AllanCurves allan_curves(SensorReading reading, const std::vector<std::vector<double>>& samples) {
  AllanCurves c{std::move(reading), samples.front().size(), {}};
  for (const std::vector<double>& y : samples) c.points.push_back(allan_deviation(y, c.reading.rate.period()));
  return c;
}

std::string allan_table(const AllanCurves& c) {
  const bool compares = is_expected(c);
  const std::size_t components = c.points.size();
  std::string out =
      fmt::format("{} of {}: {} samples at {:g} Hz, overlapping Allan deviation in {}\n", c.reading.property,
                  c.reading.sensor, c.samples, c.reading.rate.hertz(), c.reading.unit);
  if (compares && same_figures(c))
    out += "by the figures of its sensor.error: " + figures_text(c.reading.figures.front(), c.reading.unit) + "\n";
  out += fmt::format("\n{:>10}", "tau (s)");
  for (const std::string& label : c.reading.labels) out += fmt::format("{:>12}", heading(label));
  if (compares) out += fmt::format("{:>12}{:>24}", "expected", "95 % of the estimates");
  out += '\n';
  std::size_t inside = 0, all = 0;
  for (std::size_t k = 0; k < c.points.front().size(); ++k) {
    out += fmt::format("{:>10.4g}", c.points.front()[k].tau);
    for (std::size_t i = 0; i < components; ++i) {
      const AllanPoint& p = c.points[i][k];
      const ExpectedBand band = band_of(c, i, p);
      const bool fits = p.deviation >= band.low && p.deviation <= band.high;
      inside += fits;
      ++all;
      out += fmt::format("{:>11.4g}{}", p.deviation, compares && !fits ? '*' : ' ');
    }
    if (compares) {
      const ExpectedBand band = band_of(c, 0, c.points.front()[k]);
      out += fmt::format("{:>11.4g} {:>11.4g} to {:<9.4g}", band.expected, band.low, band.high);
      while (out.back() == ' ') out.pop_back();
    }
    out += '\n';
  }
  if (!compares) return out + "\nits sensor.error states no noise, so there is nothing to compare it with\n";
  out += fmt::format("\n{} of {} values lie where 95 % are expected{}\n", inside, all,
                     inside < all ? "; * marks those that do not" : "");
  if (!same_figures(c))
    out += fmt::format("components differ: expected values of the table are those of {}\n", c.reading.labels.front());
  return out;
}

std::string allan_picture(const AllanCurves& c, const std::string& scenario) {
  Chart chart;
  chart.title = fmt::format("Allan deviation of {}", c.reading.sensor);
  const std::string figures = same_figures(c) ? figures_text(c.reading.figures.front(), c.reading.unit) : "";
  chart.subtitle = fmt::format("{}{}{}", c.reading.property, figures.empty() ? "" : ": ", figures);
  if (chart.subtitle.size() > 90) chart.subtitle = fmt::format("{} of {}", c.reading.property, scenario);
  chart.x = {"averaging time", "s"};
  chart.y = {"Allan deviation", c.reading.unit};
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    Chart::Curve curve{"", {}, i};
    for (const AllanPoint& p : c.points[i])
      if (p.deviation > 0) curve.points.emplace_back(p.tau, p.deviation);
    chart.curves.push_back(std::move(curve));
    if (!c.reading.labels[i].empty()) chart.groups.push_back(c.reading.labels[i]);
  }
  if (!is_expected(c)) return svg(chart);
  const NoiseFigures& f = c.reading.figures.front();
  Chart::Band band;
  const auto add_line = [&](const std::string& label, double figure, bool first,
                            const std::function<double(const AllanPoint&)>& value) {
    if (figure <= 0) return;
    Chart::Curve line{label, {}, 0, true, first};
    for (const AllanPoint& p : c.points.front()) line.points.emplace_back(p.tau, value(p));
    chart.curves.push_back(std::move(line));
  };
  for (const AllanPoint& p : c.points.front()) {
    const ExpectedBand b = band_of(c, 0, p);
    band.x.push_back(p.tau);
    band.low.push_back(std::max(b.low, 1e-3 * b.expected));  // a logarithmic axis has no 0
    band.high.push_back(b.high);
  }
  chart.bands.push_back(std::move(band));
  add_line("N / √τ", f.noise_density, false, [&](const AllanPoint& p) { return f.white(p.tau); });
  add_line("0.664 B", f.bias_instability, true, [&](const AllanPoint&) { return f.flicker(); });
  add_line("K √(τ / 3)", f.random_walk, false, [&](const AllanPoint& p) { return f.walk(p.tau); });
  return svg(chart);
}

}  // namespace muro::host
