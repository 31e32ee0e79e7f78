// SPDX-License-Identifier: MIT
#include "core/value_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "muro/base/limits.hpp"
#include "muro/base/printable.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

namespace {

/// Returns a copy, since values in the bytes of a model need not be aligned.
template <class T>
T value_at(const void* data, std::uint32_t i) {
  T value;
  std::memcpy(static_cast<void*>(&value), static_cast<const std::byte*>(data) + std::size_t(i) * sizeof(T), sizeof(T));
  return value;
}

template <class T>
std::string first_problem(const void* data, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i)
    if (std::string problem = limits::problem_of(value_at<T>(data, i)); !problem.empty()) return problem;
  return "";
}

/// Whether a type has the name of a type of the SDK, but another size or alignment.
bool has_other_layout(const ValueType& type) {
  const ValueType* const own[] = {&value_type<Pose>,  &value_type<Twist>, &value_type<Inertia>,
                                  &value_type<Shape>, &value_type<Vec3>,  &value_type<double>};
  return std::any_of(std::begin(own), std::end(own),
                     [&](const ValueType* known) { return known->name == type.name && !(*known == type); });
}

std::string problem_of_vector(const KeyInfo& key, const Vec3& v) {
  if (key.name != keys::gravity.name) return v.allFinite() ? "" : "has an element that is not finite";
  return limits::within(limits::gravity, v) ? "" : "has a component that is not from -1e4 to 1e4 m/s^2";
}

std::string problem_of_number(const KeyInfo& key, double x) {
  if (key.name == keys::initial_joint_position.name || key.name == keys::joint_position.name)
    return limits::within(limits::joint_position, x) ? "" : "is not from -1e6 to 1e6 rad or m";
  return std::isnan(x) ? "is not a number" : "";
}

}  // namespace

std::string problem_of_values(const KeyInfo& key, const void* data, std::uint32_t count) {
  const ValueType& type = *key.type;
  if (has_other_layout(type))
    return "has the type " + std::string(type.name) + " with another layout than in this muro";
  if (type == value_type<Pose>) return first_problem<Pose>(data, count);
  if (type == value_type<Twist>) return first_problem<Twist>(data, count);
  if (type == value_type<Inertia>) return first_problem<Inertia>(data, count);
  if (type == value_type<Shape>) return first_problem<Shape>(data, count);
  std::string problem;
  for (std::uint32_t i = 0; i < count && problem.empty(); ++i) {
    if (type == value_type<Vec3>) problem = problem_of_vector(key, value_at<Vec3>(data, i));
    if (type == value_type<double>) problem = problem_of_number(key, value_at<double>(data, i));
  }
  return problem;
}

void check_values(const std::string& object, const KeyInfo& key, const void* data, std::uint32_t count) {
  const std::string problem = problem_of_values(key, data, count);
  if (!problem.empty()) throw SetupError(fmt::format("`{}` of {} {}", key.name, in_backquotes(object), problem));
}

void check_object_name(std::string_view name, const std::string& what) {
  constexpr std::size_t longest = 255;
  if (name.empty()) throw SetupError(what + " has no name");
  if (name.size() > longest)
    throw SetupError(fmt::format("{} has a name of {} bytes; at most {} are possible: {}", what, name.size(), longest,
                                 in_backquotes(name)));
  if (printable(name) != name)
    throw SetupError(
        fmt::format("{} is named {}; a name is UTF-8 without control characters", what, in_backquotes(name)));
}

}  // namespace muro
