// SPDX-License-Identifier: MIT
// Parameters and outputs of laser scanners of all methods.
#pragma once

#include <array>
#include <numbers>

#include "muro/toolkit/mounting.hpp"

namespace muro::scanner {

using std::numbers::pi;

inline constexpr Parameter parameters[] = {
    real("min_angle", "rad", -pi, "azimuth of the first ray").between(-4 * pi, 4 * pi),
    real("max_angle", "rad", pi, "azimuth of the last ray; 2 pi after the first, the ray at the seam is cast once")
        .between(-4 * pi, 4 * pi),
    integer("rays", 360, "rays in a row").between(1, 1e6),
    integer("rows", 1, "rows of rays, from the lowest elevation to the highest").between(1, 4096),
    real("min_elevation", "rad", 0, "elevation of the first row").between(-pi / 2, pi / 2),
    real("max_elevation", "rad", 0, "elevation of the last row").between(-pi / 2, pi / 2),
    reals("directions", "rad", {}, "pairs azimuth, elevation, one for each ray, instead of a grid"),
    real("min_range", "m", 0, "reading of what is nearer").between(0, 1e6),
    real("max_range", "m", 10, "what is farther is not seen; reading where nothing is seen").between(1e-6, 1e6),
    mounting_offset,
    mounting_rpy,
    boolean("see_self", false, "whether the robot that carries the scanner is seen"),
    boolean("hits", false, "also write laser.hits"),
    boolean("incidence", false, "also write laser.incidence"),
    real("divergence", "rad", 0, "full angle of the beam's cone: readings at edges are mixed; 0: a line")
        .between(0, 0.1),
    integer("sweep_steps", 1, "steps in which a scan is taken, each ray at its own time; 1: all rays at one instant")
        .between(1, 1e6),
};
inline constexpr PropertyUse writes[] = {
    {"ranges", "distance along each ray, row by row"},
    {"laser.hits", "hits: true: the object that each ray hits"},
    {"laser.incidence", "incidence: true: between each ray and the surface's normal"},
    {"laser.sweep.ranges", "sweep_steps: the scan in progress"},
    {"laser.sweep.incidence", "sweep_steps and incidence: likewise"},
    {"laser.sweep.hits", "sweep_steps and hits: likewise"},
    {"laser.sweep.pose", "sweep_steps: where the device was at the step before"},
    {"laser.min_angle", "constant"},
    {"laser.angle_increment", "constant; 0 for a list of directions"},
    {"laser.columns", "constant"},
    {"laser.rows", "constant"},
    {"laser.min_elevation", "constant"},
    {"laser.elevation_increment", "constant; 0 for a single row"},
    {"laser.min_range", "constant"},
    {"laser.max_range", "constant"},
    mounting_writes,
};

/// Returns the shared entries followed by those of a method.
template <class T, std::size_t n, std::size_t m>
constexpr std::array<T, n + m> joined(const T (&shared)[n], const T (&own)[m]) {
  std::array<T, n + m> all{};
  for (std::size_t i = 0; i < n; ++i) all[i] = shared[i];
  for (std::size_t i = 0; i < m; ++i) all[n + i] = own[i];
  return all;
}

}  // namespace muro::scanner
