// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "host/tools/compare/against_scans.hpp"
#include "host/tools/compare/chart.hpp"
#include "host/tools/compare/scanner_data.hpp"

namespace muro::host {

namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr double to_mm = 1e3, to_degrees = 180 / std::numbers::pi, percent = 100;

std::string scan_file(const ScanRecord& r) { return std::filesystem::path(r.name).filename().string(); }

/// Returns aligned columns; the first row is the header.
std::string columns_of(const Rows& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("  {:<{}}", row[i], widths[i]);
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string mm(const Spread& s) {
  if (s.count == 0) return "-";
  return fmt::format("{:.1f} ({:.1f} to {:.1f}), {}", s.median * to_mm, s.low * to_mm, s.high * to_mm, s.count);
}

/// Returns a value in mm, with its ratio to the recorded one.
std::string mm_beside(const Spread& s, const Spread& recorded) {
  if (s.count == 0 || recorded.count == 0 || !(recorded.median > 0)) return mm(s);
  return fmt::format("{}, x{:.2f}", mm(s), s.median / recorded.median);
}

const StatisticsBand* band_from(const std::vector<StatisticsBand>& bands, double from) {
  for (const StatisticsBand& b : bands)
    if (b.from == from) return &b;
  return nullptr;
}

using Bands = std::vector<StatisticsBand> ScanStatistics::*;
using Quantity = Spread StatisticsBand::*;

/// Returns the deviations of the variations that ran.
std::vector<const ScanDeviation*> those_that_ran(const std::vector<ScanDeviation>& all) {
  std::vector<const ScanDeviation*> ran;
  for (const ScanDeviation& d : all)
    if (d.failure.empty()) ran.push_back(&d);
  return ran;
}

std::string name_of_column(const ScanDeviation& d) { return d.label.empty() ? "simulated" : d.label; }

/// Known values of the scanner in a band, for a further column; empty: no such column.
struct KnownColumn {
  std::string name;
  std::function<std::string(double from, double to)> cell;
};

/// Returns a table of a quantity by bands; empty when there are no values.
std::string table_by_band(const std::string& title, const std::string& unit, double scale, Bands bands,
                          Quantity quantity, const ScanStatistics& recorded,
                          const std::vector<const ScanDeviation*>& simulated, const std::vector<KnownColumn>& known) {
  const bool has_ratio = quantity != &StatisticsBand::bias;
  std::vector<double> limits;
  std::vector<double> ends;
  const auto add = [&](const ScanStatistics& s) {
    for (const StatisticsBand& b : s.*bands) {
      if ((b.*quantity).count == 0 || std::find(limits.begin(), limits.end(), b.from) != limits.end()) continue;
      const auto place = std::lower_bound(limits.begin(), limits.end(), b.from);
      ends.insert(ends.begin() + (place - limits.begin()), b.to);
      limits.insert(place, b.from);
    }
  };
  add(recorded);
  for (const ScanDeviation* d : simulated) add(d->simulated);
  if (limits.empty()) return "";
  Rows rows{{unit, "recorded"}};
  for (const ScanDeviation* d : simulated) rows.front().push_back(name_of_column(*d));
  for (const KnownColumn& k : known) rows.front().push_back(k.name);
  constexpr double open_end = 1e5;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const StatisticsBand* own = band_from(recorded.*bands, limits[i]);
    const Spread of_record = own ? own->*quantity : Spread{};
    const double from = limits[i] * scale, to = ends[i] * scale;
    rows.push_back(
        {ends[i] > open_end ? fmt::format("above {:g}", from) : fmt::format("{:g} to {:g}", from, to), mm(of_record)});
    for (const ScanDeviation* d : simulated) {
      const StatisticsBand* b = band_from(d->simulated.*bands, limits[i]);
      rows.back().push_back(mm_beside(b ? b->*quantity : Spread{}, has_ratio ? of_record : Spread{}));
    }
    for (const KnownColumn& k : known) rows.back().push_back(k.cell(from, to));
  }
  return title + "\n" + columns_of(rows);
}

KnownColumn measured_column(const ScannerData* known, std::span<const MeasuredNoise> figures) {
  KnownColumn column;
  column.name = known ? std::string(known->measured) : "";
  column.cell = [figures](double from, double to) -> std::string {
    for (const MeasuredNoise& m : figures) {
      if (std::abs(m.from - from) > 1e-6 || std::abs(m.to - to) > 1e-6) continue;
      return m.high > 0 ? fmt::format("{:.1f} ({:.1f} to {:.1f})", m.noise * to_mm, m.low * to_mm, m.high * to_mm)
                        : fmt::format("{:.1f}", m.noise * to_mm);
    }
    return "";
  };
  return column;
}

KnownColumn sheet_column(const ScannerData* known, bool accuracy) {
  return {"data sheet", [known, accuracy](double from, double to) -> std::string {
            constexpr double open_end = 1e5;
            const double middle = to > open_end ? from : 0.5 * (from + to);
            const double figure = accuracy ? known->accuracy_at(middle) : known->repeatability_at(middle);
            return figure > 0 ? fmt::format("{}{:.0f}", accuracy ? "+-" : "at most ", figure * to_mm) : "";
          }};
}

std::string percent_of(double share) { return fmt::format("{:.2g} %", share * percent); }

std::string figure_or_dash(bool is_known, const std::string& figure) { return is_known ? figure : "-"; }

/// A figure of a scanner as a whole.
struct WholeFigure {
  const char* name;
  std::function<std::string(const ScanStatistics&)> of;
  double known;  ///< from an evaluation of a real device; 0: not given
};

std::vector<WholeFigure> whole_figures(const ScannerData* known) {
  return {
      {"edges with a mixed reading",
       [](const ScanStatistics& s) {
         return figure_or_dash(s.edges > 0, fmt::format("{} of {} in all scans", percent_of(s.mixed_share()), s.edges));
       },
       known ? known->mixed_share : 0},
      {"edges with no reading",
       [](const ScanStatistics& s) {
         return figure_or_dash(s.edges > 0,
                               percent_of(double(s.lost_edges) / double(std::max<std::size_t>(s.edges, 1))));
       },
       0},
      {"readings that drop out", [](const ScanStatistics& s) { return percent_of(s.drop_outs); },
       known ? known->lost_share : 0},
      {"beams without return", [](const ScanStatistics& s) { return percent_of(s.without_return); }, 0},
      {"correlation of neighbours",
       [](const ScanStatistics& s) {
         return figure_or_dash(s.neighbour_count > 0 && s.scans >= fewest_scans,
                               fmt::format("{:.2f}", s.neighbour_correlation));
       },
       known ? known->neighbour_correlation : 0},
      {"neighbours that read the same",
       [](const ScanStatistics& s) { return figure_or_dash(s.neighbour_count > 0, percent_of(s.equal_neighbours)); },
       known ? known->equal_neighbours : 0},
      {"resolution, mm",
       [](const ScanStatistics& s) {
         return figure_or_dash(s.resolution > 0, fmt::format("{:g}", s.resolution * to_mm));
       },
       0},
      {"beams in front of which something moved",
       [](const ScanStatistics& s) { return fmt::format("{}", s.unsteady_beams); }, 0}};
}

std::string whole_table(const ScanStatistics& recorded, const std::vector<const ScanDeviation*>& simulated,
                        const ScannerData* known) {
  const bool is_evaluated = known && !known->measured.empty();
  Rows rows{{"", "recorded"}};
  for (const ScanDeviation* d : simulated) rows.front().push_back(name_of_column(*d));
  if (is_evaluated) rows.front().push_back(std::string(known->measured));
  for (const WholeFigure& f : whole_figures(known)) {
    rows.push_back({f.name, f.of(recorded)});
    for (const ScanDeviation* d : simulated) rows.back().push_back(f.of(d->simulated));
    if (!is_evaluated || f.known == 0) continue;
    const bool is_correlation = f.known == known->neighbour_correlation;
    rows.back().push_back(is_correlation ? fmt::format("{:.2f}", f.known) : "about " + percent_of(f.known));
  }
  return "all beams\n" + columns_of(rows);
}

std::string codes_line(const ScanRecord& record) {
  std::string text;
  const double readings = double(record.beam_count() * record.ranges.size());
  for (const auto& [code, count] : record.codes)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", code, percent_of(double(count) / readings));
  return text.empty() ? "" : "error codes of the recorded scanner, of all readings: " + text + "\n";
}

/// Returns tables of the bias of record and simulation against the true ranges of each variation.
std::string bias_tables(const std::vector<const ScanDeviation*>& simulated, const ScannerData* known) {
  std::string text;
  for (const ScanDeviation* d : simulated) {
    std::vector<KnownColumn> columns;
    if (known) columns.push_back(sheet_column(known, true));
    text += table_by_band(fmt::format("bias against the true ranges of {}, mm: median (10th to 90th percentile), beams",
                                      name_of_column(*d)),
                          "range, m", 1, &ScanStatistics::by_range, &StatisticsBand::bias, d->recorded, {d}, columns);
  }
  return text;
}

}  // namespace

std::string scan_table(const ScanRecord& record, const std::vector<ScanDeviation>& deviations) {
  const ScannerData* const known = known_scanner(record.scanner);
  const std::vector<const ScanDeviation*> ran = those_that_ran(deviations);
  const ScanStatistics& recorded = deviations.front().recorded;
  std::string text = fmt::format("{}{}: {} scan{} of {} beams\n", scan_file(record),
                                 record.scanner.empty() ? "" : ", " + record.scanner, recorded.scans,
                                 recorded.scans == 1 ? "" : "s", recorded.beams);
  for (const ScanDeviation& d : deviations)
    if (!d.failure.empty()) text += fmt::format("{} did not run: {}\n", name_of_column(d), d.failure);
  for (const std::string& n : record.notes) text += "  " + n + "\n";
  if (recorded.scans < fewest_scans)
    text += fmt::format("  {} scans are the fewest that tell the noise over time\n", fewest_scans);
  const bool has_sheet = known && known->near_repeatability > 0, is_evaluated = known && !known->measured.empty();
  std::vector<KnownColumn> sheet, evaluated, oblique;
  if (has_sheet) sheet.push_back(sheet_column(known, false));
  if (is_evaluated) evaluated.push_back(measured_column(known, known->by_range));
  if (is_evaluated) oblique.push_back(measured_column(known, known->by_incidence));
  const std::string what = "mm: median (10th to 90th percentile), ";
  text += table_by_band("noise over time: standard deviation of a beam, " + what + "beams", "range, m", 1,
                        &ScanStatistics::by_range, &StatisticsBand::over_time, recorded, ran, sheet);
  text +=
      table_by_band("noise about walls: standard deviation about a line through 21 beams, " + what + "pieces",
                    "range, m", 1, &ScanStatistics::by_range, &StatisticsBand::about_walls, recorded, ran, evaluated);
  text += table_by_band("the same by incidence", "degrees", to_degrees, &ScanStatistics::by_incidence,
                        &StatisticsBand::about_walls, recorded, ran, oblique);
  text += bias_tables(ran, known);
  text += whole_table(recorded, ran, known);
  text += codes_line(record);
  if (known) text += fmt::format("data sheet of the {}: {}\n", known->name, known->source);
  return text;
}

std::string scan_csv(const std::vector<ScanRecord>& records, const std::vector<ScanDeviation>& deviations) {
  std::string text = "record,source,quantity,from,to,count,low,median,high\n";
  const auto quoted = [](std::string cell) {
    for (std::size_t at = 0; (at = cell.find('"', at)) != std::string::npos; at += 2) cell.insert(at, 1, '"');
    return '"' + cell + '"';
  };
  const std::size_t variations = deviations.size() / records.size();
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    const ScanDeviation& d = deviations[k];
    if (!d.failure.empty()) continue;
    const auto rows_of = [&](const std::string& source, const ScanStatistics& s, bool bias_alone) {
      const std::string head = quoted(records[k / variations].name) + "," + quoted(source) + ",";
      const auto spread = [&](const char* quantity, const StatisticsBand& b, const Spread& x) {
        if (x.count > 0)
          text += fmt::format("{}{},{:g},{:g},{},{:.6g},{:.6g},{:.6g}\n", head, quantity, b.from, b.to, x.count, x.low,
                              x.median, x.high);
      };
      for (const StatisticsBand& b : s.by_range) {
        if (!bias_alone) spread("noise_over_time", b, b.over_time);
        if (!bias_alone) spread("noise_about_walls", b, b.about_walls);
        spread("bias", b, b.bias);
      }
      if (bias_alone) return;
      for (const StatisticsBand& b : s.by_incidence) spread("noise_about_walls_by_incidence", b, b.about_walls);
      const std::tuple<const char*, std::size_t, double> whole[] = {
          {"mixed_edges", s.edges, s.mixed_share()},
          {"lost_edges", s.edges, s.edges > 0 ? double(s.lost_edges) / double(s.edges) : 0},
          {"drop_outs", s.readings, s.drop_outs},
          {"without_return", s.beams, s.without_return},
          {"neighbour_correlation", s.neighbour_count, s.neighbour_correlation},
          {"equal_neighbours", s.neighbour_count, s.equal_neighbours},
          {"resolution", s.readings, s.resolution}};
      for (const auto& [quantity, count, value] : whole)
        text += fmt::format("{}{},,,{},,{:.6g},\n", head, quantity, count, value);
    };
    const std::string name = d.label.empty() ? "simulated" : d.label;
    rows_of(k % variations == 0 ? "recorded" : "recorded against " + name, d.recorded, k % variations != 0);
    rows_of(name, d.simulated, false);
  }
  return text;
}

std::string scan_picture(const ScanRecord& record, const std::vector<ScanDeviation>& deviations) {
  const ScannerData* const known = known_scanner(record.scanner);
  const ScanStatistics& recorded = deviations.front().recorded;
  const Quantity quantity = recorded.scans >= fewest_scans ? &StatisticsBand::over_time : &StatisticsBand::about_walls;
  Chart chart;
  chart.title = "Noise of a laser scanner over range: " + scan_file(record);
  chart.subtitle = recorded.scans >= fewest_scans
                       ? "standard deviation of a beam over time: median; 10 to 90 % of beams"
                       : "standard deviation about walls: median; 10 to 90 % of pieces";
  chart.x = {"range", "m"};
  chart.y = {"standard deviation", "mm"};
  const auto middle = [](const StatisticsBand& b) { return std::sqrt(std::max(b.from, 0.1) * std::min(b.to, 100.0)); };
  constexpr double least = 1e-3;  // mm: a logarithmic axis has no 0
  const auto add_curve = [&](const std::string& name, const ScanStatistics& s) {
    const std::size_t group = chart.groups.size();
    Chart::Curve curve{"", {}, group};
    for (const StatisticsBand& b : s.by_range) {
      const Spread& x = b.*quantity;
      if (x.count == 0) continue;
      curve.points.emplace_back(middle(b), std::max(x.median * to_mm, least));
      chart.points.push_back({"", middle(b), std::max(x.median * to_mm, least), group, false});
    }
    chart.curves.push_back(std::move(curve));
    chart.groups.push_back(name);
  };
  add_curve("recorded", recorded);
  Chart::Band band;
  for (const StatisticsBand& b : recorded.by_range) {
    const Spread& x = b.*quantity;
    if (x.count == 0) continue;
    band.x.push_back(middle(b));
    band.low.push_back(std::max(x.low * to_mm, least)), band.high.push_back(std::max(x.high * to_mm, least));
  }
  if (!band.x.empty()) chart.bands.push_back(std::move(band));
  for (const ScanDeviation* d : those_that_ran(deviations)) add_curve(name_of_column(*d), d->simulated);
  if (known && known->near_repeatability > 0) {
    Chart::Curve sheet{"data sheet", {}, 0, true};
    for (const double range : {0.1, known->near_to, known->near_to * 1.001, 100.0})
      sheet.points.emplace_back(range, known->repeatability_at(range) * to_mm);
    chart.curves.push_back(std::move(sheet));
  }
  return svg(chart);
}

}  // namespace muro::host
