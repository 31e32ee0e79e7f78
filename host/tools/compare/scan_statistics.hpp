// SPDX-License-Identifier: MIT
// Noise, mixed pixels and drop-outs of a laser scanner that stands still, from its scans alone.
#pragma once

#include <cstddef>
#include <vector>

#include "host/tools/compare/scan_record.hpp"

namespace muro::host {

/// How a quantity is spread.
struct Spread {
  std::size_t count = 0;
  double low = 0, median = 0, high = 0;  ///< 10th, 50th and 90th percentile; 0 where `count` is 0
};

/// From `from` to `to` (m of range, or rad of incidence).
struct StatisticsBand {
  double from = 0, to = 0;
  Spread over_time;    ///< m: of each beam, the standard deviation of its ranges over the scans
  Spread about_walls;  ///< m: of each piece of wall in each scan, the standard deviation about its line
  Spread bias;         ///< m: of each beam, mean range minus true range; only where the true ranges are given
};

/// What is a depth edge: neighbouring surfaces whose ranges differ by `edge_jump` (m) or more. A reading is mixed where
/// it lies between both by `mixed_margin` (m) or more.
inline constexpr double edge_jump = 0.3, mixed_margin = edge_jump / 3;
/// The fewest scans that tell a standard deviation over time, and readings of a beam in them.
inline constexpr std::size_t fewest_scans = 10;

struct ScanStatistics {
  std::size_t scans = 0, beams = 0;
  std::size_t steady_beams = 0;          ///< whose noise counts: they read in most scans, always the same surface
  std::size_t unsteady_beams = 0;        ///< in front of which something moved, or at an edge that is seen now and then
  std::vector<StatisticsBand> by_range;  ///< without bands that nothing is in
  std::vector<StatisticsBand> by_incidence;  ///< on walls
  double neighbour_correlation = 0;          ///< of the deviations of neighbouring beams from their means, -1 .. 1
  double equal_neighbours = 0;               ///< share of neighbouring readings that are the same
  std::size_t neighbour_count = 0;           ///< pairs behind both; 0: they are not known
  double resolution = 0;                     ///< m: of which all ranges are whole multiples; 0: there is none
  std::size_t edges = 0, mixed_edges = 0, lost_edges = 0;  ///< over all scans; with a mixed reading, with none at all
  std::size_t readings = 0;                                ///< that are ranges
  double drop_outs = 0;       ///< share of missing readings of beams that read in at least half of the scans
  double without_return = 0;  ///< share of beams that read in less than half of the scans

  double mixed_share() const { return edges > 0 ? double(mixed_edges) / double(edges) : 0; }
};

/// `true_ranges`: m, of each beam, no_range where they are not known; empty: of none. `record` has its angles.
ScanStatistics statistics_of(const ScanRecord& record, const std::vector<double>& true_ranges = {});

}  // namespace muro::host
