// SPDX-License-Identifier: MIT
#include "ranges.hpp"

#include <algorithm>
#include <cmath>

#include "message.hpp"
#include "muro/base/limits.hpp"

namespace muro::model_file {

namespace {

constexpr struct {
  std::string_view name;
  double limit;
  std::string_view unit;
} known_ranges[] = {
    {"xyz", limits::position, " m"},
    {"pos", limits::position, " m"},
    {"rpy", limits::angle, " rad"},
    {"mass", limits::max_mass, " kg"},
    {"size", limits::max_size, " m"},
    {"radius", limits::max_size, " m"},
    {"length", limits::max_size, " m"},
    {"scale", limits::max_size, ""},
    {"ixx", limits::inertia, " kg m^2"},
    {"iyy", limits::inertia, " kg m^2"},
    {"izz", limits::inertia, " kg m^2"},
    {"ixy", limits::inertia, " kg m^2"},
    {"ixz", limits::inertia, " kg m^2"},
    {"iyz", limits::inertia, " kg m^2"},
    {"gravity", limits::gravity, " m/s^2"},
    {"damping", limits::joint_resistance, ""},
    {"friction", limits::joint_resistance, ""},
    {"armature", limits::inertia, ""},
    {"multiplier", limits::joint_position, ""},
    {"offset", limits::joint_position, ""},
};
constexpr std::string_view sizes[] = {"size", "radius", "length", "scale"};

std::string beyond(std::span<const double> values, double limit, std::string_view unit) {
  for (const double v : values)
    if (!limits::within(limit, v)) return concat("has a number beyond ", limit, unit);
  return {};
}

}  // namespace

void drop_tiny_sizes(std::string_view name, std::span<double> values) {
  if (std::find(std::begin(sizes), std::end(sizes), name) == std::end(sizes)) return;
  for (double& v : values)
    if (std::abs(v) < limits::min_size) v = 0;
}

std::string range_problem(std::string_view name, std::span<const double> values) {
  if (name == "pose") {
    const std::string problem = range_problem("xyz", values.first(std::min<std::size_t>(3, values.size())));
    return problem.empty() && values.size() == 6 ? range_problem("rpy", values.subspan(3)) : problem;
  }
  for (const auto& range : known_ranges)
    if (range.name == name) return beyond(values, range.limit, range.unit);
  return {};
}

}  // namespace muro::model_file
