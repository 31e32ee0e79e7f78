// SPDX-License-Identifier: MIT
// Data of laser scanners from data sheets and evaluations.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace muro::host {

/// Noise in a band `from` .. `to` (m of range, or degrees of incidence): one figure, and its range.
struct MeasuredNoise {
  double from, to;
  double noise;      ///< m: standard deviation about a wall
  double low, high;  ///< m; 0: not given
};

struct ScannerData {
  std::string_view name;                         ///< name that the device gives itself, or its beginning
  double near_to;                                ///< m
  double near_accuracy, far_accuracy;            ///< m
  double far_relative;                           ///< relative to the range, instead of `far_accuracy`; 0: none
  double near_repeatability, far_repeatability;  ///< m: standard deviation, at most; 0: not given
  std::string_view source;
  std::span<const MeasuredNoise> by_range, by_incidence;                    ///< of one device in one room
  double neighbour_correlation, equal_neighbours, mixed_share, lost_share;  ///< of the same device; 0: not given
  std::string_view measured;                                                ///< their source; empty: none

  /// m, +-.
  double accuracy_at(double range) const {
    return range <= near_to ? near_accuracy : far_relative > 0 ? far_relative * range : far_accuracy;
  }
  double repeatability_at(double range) const { return range <= near_to ? near_repeatability : far_repeatability; }
};

inline constexpr MeasuredNoise urg_by_range[] = {{0.6, 1, 2.1e-3, 1.5e-3, 2.6e-3}, {1, 1.5, 2.4e-3, 0, 0}};
inline constexpr MeasuredNoise urg_by_incidence[] = {
    {0, 20, 2.1e-3, 0, 0}, {20, 40, 2.5e-3, 0, 0}, {40, 60, 4.7e-3, 0, 0}};

/// Data from Hokuyo's data sheets; measured data from an evaluation of 121 scans of a URG-04LX with firmware 3.1.04.
inline constexpr ScannerData known_scanners[] = {
    {"URG-04LX", 1, 10e-3, 0, 0.01, 0, 0, "+-10 mm to 1 m, then +-1 %", urg_by_range, urg_by_incidence, 0.52, 0.5, 0.08,
     0.006, "a real URG-04LX (121 scans)"},
    {"UTM-30LX",
     10,
     30e-3,
     50e-3,
     0,
     10e-3,
     30e-3,
     "+-30 mm to 10 m, then +-50 mm; repeatability 10 and 30 mm",
     {},
     {},
     0,
     0,
     0,
     0,
     ""},
    {"UST-10LX", 100, 40e-3, 40e-3, 0, 30e-3, 30e-3, "+-40 mm; repeatability 30 mm", {}, {}, 0, 0, 0, 0, ""}};

/// Returns the data of a scanner; null when it is unknown.
inline const ScannerData* known_scanner(std::string_view name) {
  for (const ScannerData& s : known_scanners)
    if (name.find(s.name) != std::string_view::npos) return &s;
  return nullptr;
}

}  // namespace muro::host
