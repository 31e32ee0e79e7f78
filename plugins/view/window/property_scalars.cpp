// SPDX-License-Identifier: MIT
#include "property_scalars.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "muro/base/limits.hpp"
#include "plugins/common/text/with_scalar.hpp"

namespace muro::view {

namespace {

template <class T>
double read(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return double(value);
}

template <class T>
void write(std::byte* at, double number) {
  T value{};
  if constexpr (std::is_integral_v<T>) {
    // the greatest double that the type holds; NaN becomes 0
    const double most = std::nextafter(std::ldexp(1.0, std::numeric_limits<T>::digits), 0.0);
    value = std::isnan(number) ? T(0) : T(std::clamp(number, double(std::numeric_limits<T>::lowest()), most));
  } else {
    value = T(number);
  }
  std::memcpy(at, &value, sizeof value);
}

double read(Scalar kind, const std::byte* at) {
  return with_scalar(kind, [&]<class T>(T) { return read<T>(at); });
}

void write(Scalar kind, std::byte* at, double number) {
  with_scalar(kind, [&]<class T>(T) { write<T>(at, std::is_integral_v<T> ? std::round(number) : number); });
}

/// Returns whether an element may have its present value, with `entered` as one of its numbers.
bool is_possible(const ValueType& type, std::byte* element, double entered) {
  constexpr double largest = 1e15;
  if (!limits::within(largest, entered)) return false;
  if (type.name == ValueTraits<Twist>::name) return limits::problem_of(*reinterpret_cast<Twist*>(element)).empty();
  if (type.name != ValueTraits<Pose>::name) return true;
  Pose& pose = *reinterpret_cast<Pose*>(element);
  const double norm = pose.orientation.norm();
  if (!(norm > 1e-6)) return false;
  if (std::abs(norm - 1) > 1e-9) pose.orientation.coeffs() /= norm;
  return limits::problem_of(pose).empty();
}

std::byte* place_of(const LiveProperty& p, std::uint32_t i) {
  const ValueType& type = *p.key->type;
  return static_cast<std::byte*>(p.data) + std::size_t(i / type.scalars()) * type.size +
         (i % type.scalars()) * size_of(type.scalar);
}

}  // namespace

std::uint32_t Scalars::size() const {
  const ValueType& type = *property.key->type;
  return size_of(type.scalar) == 0 ? 0 : property.count * type.scalars();
}

std::string Scalars::label(std::uint32_t i) const {
  const ValueType& type = *property.key->type;
  std::string text =
      property.multiplicity == Multiplicity::single ? "" : "[" + std::to_string(i / type.scalars()) + "]";
  if (!type.labels.empty()) text += (text.empty() ? "" : ".") + std::string(type.labels[i % type.scalars()]);
  return text;
}

double Scalars::get(std::uint32_t i) const { return read(property.key->type->scalar, place_of(property, i)); }

bool Scalars::set(std::uint32_t i, double value) const {
  const ValueType& type = *property.key->type;
  std::byte* const element = place_of(property, i / type.scalars() * type.scalars());
  const std::vector<std::byte> before(element, element + type.size);
  write(type.scalar, place_of(property, i), value);
  if (is_possible(type, element, value)) return true;
  std::copy(before.begin(), before.end(), element);
  return false;
}

std::string summary_of(const LiveProperty& p, const Inspection& simulation) {
  const Scalars values(p);
  const std::string_view type = p.key->type->name;
  constexpr std::uint32_t most = 7;
  if (values.size() == 0) return std::to_string(p.count) + " x " + std::string(type);
  std::string text;
  for (std::uint32_t i = 0; i < std::min(most, values.size()); ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%.5g", values.get(i));
    std::string shown = number;
    if (type == "muro.ObjectId") {
      const ObjectId id{std::uint32_t(values.get(i))};
      shown = id == no_object ? "none" : std::string(simulation.object_name(id));
    } else if (type == "muro.TextId") {
      shown = simulation.text(TextId(std::uint32_t(values.get(i))));
    }
    text += (i > 0 ? ", " : "") + shown;
  }
  if (values.size() > most) text += ", ... (" + std::to_string(p.count) + ")";
  return text;
}

}  // namespace muro::view
