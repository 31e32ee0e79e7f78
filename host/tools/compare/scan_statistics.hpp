// SPDX-License-Identifier: MIT
// Noise, mixed pixels and drop-outs of a laser scanner that stands still, found only from its scans.
#pragma once

#include <cstddef>
#include <vector>

#include "host/tools/compare/scan_record.hpp"

namespace muro::host {

/// The spread of a quantity.
struct Spread {
  std::size_t count = 0;
  double low = 0, median = 0, high = 0;  ///< 10th, 50th and 90th percentile; 0 when `count` is 0
};

/// Statistics from `from` to `to` (m of range, or rad of incidence).
struct StatisticsBand {
  double from = 0, to = 0;
  Spread over_time;    ///< m: for each beam, the standard deviation of its ranges over the scans
  Spread about_walls;  ///< m: for each piece of wall in each scan, the standard deviation from its line
  Spread bias;         ///< m: for each beam, mean range minus true range; only when the true ranges are given
};

/// A depth edge: neighbouring surfaces with ranges that differ by `edge_jump` (m) or more. A reading is mixed when it
/// is between both by `mixed_margin` (m) or more.
inline constexpr double edge_jump = 0.3, mixed_margin = edge_jump / 3;
/// Least number of scans, and of readings of a beam in them, for a standard deviation over time.
inline constexpr std::size_t fewest_scans = 10;

struct ScanStatistics {
  std::size_t scans = 0, beams = 0;
  std::size_t steady_beams = 0;              ///< their noise counts: they mostly read one surface
  std::size_t unsteady_beams = 0;            ///< something moved in front, or an edge is seen at times
  std::vector<StatisticsBand> by_range;      ///< without empty bands
  std::vector<StatisticsBand> by_incidence;  ///< on walls
  double neighbour_correlation = 0;          ///< of the deviations of neighbouring beams from their means, -1 .. 1
  double equal_neighbours = 0;               ///< share of neighbouring readings that are equal
  std::size_t neighbour_count = 0;           ///< number of pairs for both; 0: they are unknown
  double resolution = 0;                     ///< m: all ranges are multiples of it; 0: there is none
  std::size_t edges = 0, mixed_edges = 0, lost_edges = 0;  ///< over all scans; with a mixed reading; without any
  std::size_t readings = 0;                                ///< number of readings that are ranges
  double drop_outs = 0;       ///< share of missing readings, for beams that read in at least half of the scans
  double without_return = 0;  ///< share of beams that read in less than half of the scans

  double mixed_share() const { return edges > 0 ? double(mixed_edges) / double(edges) : 0; }
};

/// Statistics of `record`, which has its angles. `true_ranges`: m, by beam, no_range when unknown; empty: unknown.
ScanStatistics statistics_of(const ScanRecord& record, const std::vector<double>& true_ranges = {});

}  // namespace muro::host
