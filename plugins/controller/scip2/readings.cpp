// SPDX-License-Identifier: MIT
#include "readings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"

namespace muro::scip2 {

namespace {

/// Shortest run of steps without return that gets marked edges.
constexpr std::size_t shortest_marked_run = 3;
/// Limit for neighbours on one surface: largest difference of their distances, as a fraction of the nearer one.
constexpr double depth_edge = 0.2;

}  // namespace

Readings::Readings(const Model& model, const RayGrid& grid) : model_(model) {
  constexpr double turn = 2 * std::numbers::pi;
  const double step_angle = turn / model.steps_per_turn;
  for (std::size_t steps = 0; steps < half_angles_.size(); ++steps) {
    const double half = 0.5 * double(steps) * step_angle;
    half_angles_[steps] = {elementary::sin(half), elementary::cos(half)};
  }
  const double increment = grid.columns > 1 ? grid.angle_increment : step_angle;
  rays_per_step_ = step_angle / increment;
  const bool is_full_turn = std::abs(increment * grid.columns - turn) < 1e-9 * turn;
  for (std::int32_t step = model.first_step; step <= model.last_step; ++step) {
    // add full turns: the device's angle that is nearest to the middle of the rays
    const double middle = grid.min_angle + 0.5 * increment * (grid.columns - 1);
    double angle = model.angle_of(step);
    angle += turn * std::round((middle - angle) / turn);
    auto column = std::llround((angle - grid.min_angle) / increment);
    if (is_full_turn) column = (column % grid.columns + grid.columns) % grid.columns;
    const bool has_ray = column >= 0 && column < std::int64_t(grid.columns);
    rays_.push_back(has_ray ? grid.first_ray + std::uint32_t(column) : no_ray);
  }
}

std::uint32_t Readings::steps_without_ray() const {
  return std::uint32_t(std::count(rays_.begin(), rays_.end(), no_ray));
}

void Readings::read(const LaserScan& scan, std::span<std::uint32_t> distances,
                    std::span<std::uint32_t> intensities) const {
  for (std::size_t i = 0; i < rays_.size(); ++i) distances[i] = rays_[i] == no_ray ? 0 : distance(scan, rays_[i]);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const std::uint32_t mm = distances[i];
    const bool is_code = mm < std::uint32_t(model_.min_distance) || mm > std::uint32_t(model_.max_distance);
    if (is_code || rays_[i] == no_ray) {
      intensities[i] = 0;
      continue;
    }
    const double cosine = scan.incidence.empty() ? cosine_of_incidence(distances, i)
                                                 : std::abs(elementary::cos(scan.incidence[rays_[i]]));
    intensities[i] = intensity_of(1e-3 * mm, cosine);
  }
  if (model_.marks_edges) mark_edges(distances);
}

std::uint32_t Readings::distance(const LaserScan& scan, std::uint32_t ray) const {
  const double range = scan.ranges[ray];
  if (scan.truth[ray] >= scan.max_range || !(range > 0) || !std::isfinite(range)) return model_.no_return_code;
  const double mm = std::round(1e3 * range);
  if (mm > model_.max_distance) return model_.no_return_code;
  if (mm < model_.min_distance) return model_.too_near_code;
  return std::uint32_t(mm);
}

/// Returns the cosine of the angle between the ray and the normal of a line through neighbours on the same surface.
double Readings::cosine_of_incidence(std::span<const std::uint32_t> distances, std::size_t i) const {
  const double here = distances[i];
  const auto is_same_surface = [&](std::size_t k) {
    return distances[k] >= std::uint32_t(model_.min_distance) &&
           std::abs(distances[k] - here) <= depth_edge * std::min<double>(here, distances[k]);
  };
  const std::size_t before = i > 0 && is_same_surface(i - 1) ? i - 1 : i;
  const std::size_t behind = i + 1 < distances.size() && is_same_surface(i + 1) ? i + 1 : i;
  if (before == behind) return 1;
  // in the plane of the scan, x along the ray
  const HalfAngle& half = half_angles_[behind - before];
  const double along = (double(distances[behind]) - distances[before]) * half.cosine;
  const double across = (double(distances[behind]) + distances[before]) * half.sine;
  return across / std::sqrt(along * along + across * across);
}

/// Marks a run of steps without return: its first and last step read 7 when a step beside it has a return.
void Readings::mark_edges(std::span<std::uint32_t> distances) const {
  const auto is_empty = [&](std::size_t i) { return distances[i] == model_.no_return_code && rays_[i] != no_ray; };
  for (std::size_t begin = 0; begin < distances.size();) {
    if (!is_empty(begin)) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < distances.size() && is_empty(end)) ++end;
    if (end - begin >= shortest_marked_run) {
      if (begin > 0 && rays_[begin - 1] != no_ray) distances[begin] = edge_code;
      if (end < distances.size() && rays_[end] != no_ray) distances[end - 1] = edge_code;
    }
    begin = end;
  }
}

std::uint32_t intensity_of(double distance, double cosine_of_incidence) {
  return std::uint32_t(std::lround(10000 * cosine_of_incidence / (1 + distance * distance)));
}

}  // namespace muro::scip2
