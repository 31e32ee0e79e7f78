// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "tests/bench/baselines/city.hpp"

namespace muro::bench {

/// The rays of a scanner, row by row from below, each row from right to left: 240 degrees across and, with several
/// rows, 30 degrees high; 360 and 45 degrees from 1024 columns on.
struct Pattern {
  int columns = 0, rows = 0;
  bool full_circle = false;
  double horizontal_fov = 0, vertical_fov = 0;  ///< rad
  std::vector<float> x, y, z;                   ///< unit directions in the scanner's frame

  Pattern(int columns, int rows);
  int size() const { return columns * rows; }
  std::string name() const { return std::to_string(columns) + "x" + std::to_string(rows); }
};

/// The height of the scanner (m) above the chassis' centre; its axes are those of the chassis.
inline constexpr double scanner_height = 0.13;

/// A prescribed motion of the whole team: poses of all chassis at time `t` (s).
void drive(const City& city, double t, std::vector<Pose>& poses);

/// A scanner on every vehicle of a city, in some engine. Every scanner sees everything, its own vehicle too.
class Scanners {
 public:
  virtual ~Scanners() = default;
  /// Scans with all scanners from vehicles at `poses`; `moved`: whether they have moved since the last scan.
  virtual void scan(std::span<const Pose> poses, bool moved) = 0;
  /// The range of a ray (m): the distance to the nearest surface, or the maximum range of the scanner.
  virtual double range(int vehicle, int ray) const = 0;
};

/// An engine, or one way to use it.
struct RayEngine {
  std::string name;
  bool embree = false;
  std::function<std::unique_ptr<Scanners>(const City&, const Pattern&, double range)> make;
  double max_rays = 1e300;  ///< of a scan; larger scans are not measured
};

/// Returns the engines that the build has found.
std::vector<RayEngine> ray_baselines();

/// `width`: rays in a call, 1, 8 or 16.
std::unique_ptr<Scanners> embree_scanners(const City& city, const Pattern& pattern, double range, int width);
std::unique_ptr<Scanners> bullet_scanners(const City& city, const Pattern& pattern, double range);

}  // namespace muro::bench
