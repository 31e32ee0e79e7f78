// SPDX-License-Identifier: MIT
#include "host/tools/compare/scan_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "muro/base/elementary.hpp"

namespace muro::host {

namespace {

constexpr double range_limits[] = {0, 0.3, 0.6, 1, 1.5, 2.5, 4, 6, 10, 15, 20, 30, 60, 1e6};  // m
constexpr double incidence_limits[] = {0, 20, 40, 60, 80};                                    // degrees
constexpr std::size_t wall_beams = 21;                                                        // in a piece of wall
constexpr double most_rough = 0.004;         // m: largest deviation of a wall from its line
constexpr double flat_step = edge_jump / 3;  // m: largest step between neighbours on one surface
constexpr double one_degree = std::numbers::pi / 180;

Spread spread_of(std::vector<double> values) {
  Spread s;
  s.count = values.size();
  if (values.empty()) return s;
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    const double place = part * double(values.size() - 1);
    const auto below = std::size_t(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (place - double(below)) * (values[above] - values[below]);
  };
  s.low = at(0.1), s.median = at(0.5), s.high = at(0.9);
  return s;
}

/// Summary of a beam over all scans.
struct BeamSummary {
  std::size_t count = 0;
  double mean = no_range, deviation = no_range;
  double least = no_range, most = no_range;
  bool is_steady = false;
};

BeamSummary summary_of(const ScanRecord& r, std::size_t beam) {
  BeamSummary b;
  double sum = 0;
  for (const auto& scan : r.ranges) {
    const double x = scan[beam];
    if (std::isnan(x)) continue;
    sum += x, ++b.count;
    b.least = b.count == 1 ? x : std::min(b.least, x);
    b.most = b.count == 1 ? x : std::max(b.most, x);
  }
  if (b.count == 0) return b;
  b.mean = sum / double(b.count);
  double squares = 0;
  for (const auto& scan : r.ranges)
    if (!std::isnan(scan[beam])) squares += (scan[beam] - b.mean) * (scan[beam] - b.mean);
  if (b.count > 1) b.deviation = std::sqrt(squares / double(b.count - 1));
  return b;
}

/// The line of a wall: x cos(angle) + y sin(angle) = distance.
struct WallLine {
  double angle = 0, distance = 0;
  double range_at(double beam) const { return distance / elementary::cos(beam - angle); }
};

/// Fits a line by total least squares; nothing when a beam has no range.
std::optional<WallLine> line_through(const std::vector<double>& angles, const double* ranges, std::size_t first) {
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  constexpr auto n = double(wall_beams);
  for (std::size_t i = first; i < first + wall_beams; ++i) {
    if (std::isnan(ranges[i])) return std::nullopt;
    const double px = ranges[i] * elementary::cos(angles[i]), py = ranges[i] * elementary::sin(angles[i]);
    x += px, y += py, xx += px * px, xy += px * py, yy += py * py;
  }
  xx -= x * x / n, xy -= x * y / n, yy -= y * y / n;
  WallLine w;
  w.angle = 0.5 * elementary::atan2(-2 * xy, yy - xx);  // angle of the normal
  w.distance = (x * elementary::cos(w.angle) + y * elementary::sin(w.angle)) / n;
  if (w.distance < 0) w.distance = -w.distance, w.angle += std::numbers::pi;
  return w;
}

/// Deviation (m) of the ranges from the line, which takes two degrees of freedom.
double deviation_from(const WallLine& w, const std::vector<double>& angles, const double* ranges, std::size_t first) {
  double squares = 0;
  for (std::size_t i = first; i < first + wall_beams; ++i) {
    const double e = ranges[i] - w.range_at(angles[i]);
    squares += e * e;
  }
  return std::sqrt(squares / double(wall_beams - 2));
}

class Statistics {
 public:
  Statistics(const ScanRecord& record, const std::vector<double>& truth) : r_(record), truth_(truth) {
    s_.scans = r_.ranges.size(), s_.beams = r_.beam_count();
    for (std::size_t i = 0; i < s_.beams; ++i) beams_.push_back(summary_of(r_, i));
    for (std::size_t i = 0; i < s_.beams; ++i) judge(i);
  }

  ScanStatistics all() {
    sort_by_range();
    walk_along_walls();
    compare_neighbours();
    count_edges();
    count_missing();
    s_.resolution = resolution();
    take_bands(std::begin(range_limits), std::end(range_limits), 1, by_range_, s_.by_range);
    take_bands(std::begin(incidence_limits), std::end(incidence_limits), one_degree, by_incidence_, s_.by_incidence);
    return s_;
  }

 private:
  struct Samples {
    std::vector<double> over_time, about_walls, bias;
  };

  bool reads_mostly(const BeamSummary& b) const { return b.count > 0 && 2 * b.count >= s_.scans; }

  /// Decides whether a beam is steady: it reads in most scans, always one surface, and so do its neighbours.
  void judge(std::size_t i) {
    BeamSummary& b = beams_[i];
    if (!reads_mostly(b)) return;
    const bool is_one_surface = b.most - b.least < edge_jump;
    bool is_at_edge = false;
    for (const std::ptrdiff_t step : {-2, -1, 1, 2}) {
      const std::ptrdiff_t k = std::ptrdiff_t(i) + step;
      if (k < 0 || k >= std::ptrdiff_t(s_.beams)) continue;
      const double other = beams_[std::size_t(k)].mean;
      is_at_edge = is_at_edge || !(std::abs(other - b.mean) <= flat_step * std::abs(double(step)));
    }
    b.is_steady = is_one_surface && !is_at_edge;
    if (!is_one_surface) ++s_.unsteady_beams;
    if (b.is_steady) ++s_.steady_beams;
  }

  static std::size_t band_of(const double* limits, std::size_t count, double unit, double x) {
    std::size_t k = 0;
    while (k + 2 < count && x >= limits[k + 1] * unit) ++k;
    return k;
  }
  Samples& at_range(double range) { return by_range_[band_of(range_limits, std::size(range_limits), 1, range)]; }

  void sort_by_range() {
    for (std::size_t i = 0; i < s_.beams; ++i) {
      const BeamSummary& b = beams_[i];
      if (!b.is_steady) continue;
      if (b.count >= fewest_scans) at_range(b.mean).over_time.push_back(b.deviation);
      if (i < truth_.size() && !std::isnan(truth_[i]) && std::abs(truth_[i] - b.mean) < edge_jump)
        at_range(b.mean).bias.push_back(b.mean - truth_[i]);
    }
  }

  /// Checks pieces of `wall_beams` neighbouring steady beams, one after the other. A wall is straight in the mean.
  void walk_along_walls() {
    std::vector<double> means;
    for (const BeamSummary& b : beams_) means.push_back(b.is_steady ? b.mean : no_range);
    for (std::size_t first = 0; first + wall_beams <= s_.beams;) {
      const std::optional<WallLine> mean_line = line_through(r_.angles, means.data(), first);
      if (!mean_line || !is_wall(*mean_line, means, first)) {
        ++first;
        continue;
      }
      add_wall(*mean_line, first);
      first += wall_beams;
    }
  }

  bool is_wall(const WallLine& line, const std::vector<double>& means, std::size_t first) const {
    double noise = 0;
    for (std::size_t i = first; i < first + wall_beams; ++i)
      if (beams_[i].count > 1) noise += beams_[i].deviation * beams_[i].deviation / double(beams_[i].count);
    noise = std::sqrt(noise / double(wall_beams));
    constexpr double of_one_scan = 5;  // times `most_rough`: its noise is unknown
    const double most = s_.scans > 1 ? most_rough + 3 * noise : of_one_scan * most_rough;
    return deviation_from(line, r_.angles, means.data(), first) <= most;
  }

  void add_wall(const WallLine& mean_line, std::size_t first) {
    const std::size_t middle = first + wall_beams / 2;
    double incidence = std::abs(r_.angles[middle] - mean_line.angle);
    incidence = std::abs(std::remainder(incidence, 2 * std::numbers::pi));
    Samples& oblique = by_incidence_[band_of(incidence_limits, std::size(incidence_limits), one_degree, incidence)];
    for (const auto& scan : r_.ranges) {
      const std::optional<WallLine> line = line_through(r_.angles, scan.data(), first);
      if (!line) continue;
      const double deviation = deviation_from(*line, r_.angles, scan.data(), first);
      at_range(beams_[middle].mean).about_walls.push_back(deviation);
      oblique.about_walls.push_back(deviation);
    }
    for (std::size_t i = first; i < first + wall_beams; ++i)
      if (beams_[i].count >= fewest_scans) oblique.over_time.push_back(beams_[i].deviation);
  }

  void compare_neighbours() {
    double products = 0, squares = 0;
    std::size_t same = 0;
    for (std::size_t i = 0; i + 1 < s_.beams; ++i) {
      const BeamSummary &a = beams_[i], &b = beams_[i + 1];
      if (!a.is_steady || !b.is_steady) continue;
      for (const auto& scan : r_.ranges) {
        if (std::isnan(scan[i]) || std::isnan(scan[i + 1])) continue;
        const double left = scan[i] - a.mean, right = scan[i + 1] - b.mean;
        products += left * right, squares += 0.5 * (left * left + right * right);
        same += scan[i] == scan[i + 1];
        ++s_.neighbour_count;
      }
    }
    if (s_.scans < fewest_scans) squares = 0;
    s_.neighbour_correlation = squares > 0 ? products / squares : 0;
    s_.equal_neighbours = s_.neighbour_count > 0 ? double(same) / double(s_.neighbour_count) : 0;
  }

  void count_edges() {
    for (const auto& scan : r_.ranges)
      for (std::size_t i = 1; i + 2 < s_.beams; ++i) i += edge_at(scan, i);
  }

  static bool is_flat(double a, double b) { return std::abs(a - b) <= flat_step; }

  /// Whether an edge begins after beam `i`, with up to two readings in it. Returns the number of its beams.
  std::size_t edge_at(const std::vector<double>& scan, std::size_t i) {
    if (std::isnan(scan[i]) || !is_flat(scan[i - 1], scan[i])) return 0;
    for (std::size_t between = 0; between <= 2 && i + between + 2 < s_.beams; ++between) {
      const std::size_t j = i + between + 1;
      if (!is_flat(scan[j], scan[j + 1]) || !(std::abs(scan[j] - scan[i]) >= edge_jump)) continue;
      const double low = std::min(scan[i], scan[j]) + mixed_margin, high = std::max(scan[i], scan[j]) - mixed_margin;
      std::size_t mixed = 0, lost = 0;
      for (std::size_t k = i + 1; k < j; ++k) {
        mixed += scan[k] > low && scan[k] < high;
        lost += std::isnan(scan[k]);
      }
      ++s_.edges;
      s_.mixed_edges += mixed > 0;
      s_.lost_edges += mixed == 0 && lost > 0;
      return between;
    }
    return 0;
  }

  void count_missing() {
    std::size_t possible = 0, missing = 0, without = 0;
    for (const BeamSummary& b : beams_) {
      s_.readings += b.count;
      if (reads_mostly(b))
        possible += s_.scans, missing += s_.scans - b.count;
      else
        ++without;
    }
    s_.drop_outs = possible > 0 ? double(missing) / double(possible) : 0;
    s_.without_return = s_.beams > 0 ? double(without) / double(s_.beams) : 0;
  }

  double resolution() const {
    constexpr double unit = 1e-6, finest = 1e-5, rounding = 1e-3;  // m; m; units
    std::int64_t step = 0;
    for (const auto& scan : r_.ranges)
      for (const double x : scan) {
        if (std::isnan(x)) continue;
        const double units = x / unit;
        if (units > 1e12 || std::abs(units - std::round(units)) > rounding) return 0;
        step = std::gcd(step, std::int64_t(std::llround(units)));
        if (double(step) * unit < finest) return 0;
      }
    return double(step) * unit;
  }

  static void take_bands(const double* begin, const double* end, double unit, Samples* samples,
                         std::vector<StatisticsBand>& to) {
    for (const double* limit = begin; limit + 1 != end; ++limit) {
      const Samples& s = samples[limit - begin];
      if (s.over_time.empty() && s.about_walls.empty() && s.bias.empty()) continue;
      to.push_back(
          {limit[0] * unit, limit[1] * unit, spread_of(s.over_time), spread_of(s.about_walls), spread_of(s.bias)});
    }
  }

  const ScanRecord& r_;
  const std::vector<double>& truth_;
  ScanStatistics s_;
  std::vector<BeamSummary> beams_;
  Samples by_range_[std::size(range_limits)], by_incidence_[std::size(incidence_limits)];
};

}  // namespace

ScanStatistics statistics_of(const ScanRecord& record, const std::vector<double>& true_ranges) {
  return Statistics(record, true_ranges).all();
}

}  // namespace muro::host
