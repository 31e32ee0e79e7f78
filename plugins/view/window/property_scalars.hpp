// SPDX-License-Identifier: MIT
// Values of properties as numbers and as text.
#pragma once

#include <string>

#include "muro/ext/inspection.hpp"

namespace muro::view {

/// Scalars of a property, numbered through all of its elements.
struct Scalars {
  explicit Scalars(const LiveProperty& p) : property(p) {}

  /// Returns the number of scalars; 0 for opaque values.
  std::uint32_t size() const;
  /// Returns "x", "[3]" or "[3].x"; empty for a single number.
  std::string label(std::uint32_t i) const;
  double get(std::uint32_t i) const;
  /// Leaves the property as it is, and returns false, when its value would be out of range (muro/base/limits.hpp).
  /// An orientation stays of length 1.
  bool set(std::uint32_t i, double value) const;

  const LiveProperty& property;
};

/// Returns all values in one line, shortened: "1.25, -0.5, 3". For a property without numbers: count and type.
std::string summary_of(const LiveProperty& property, const Inspection& simulation);

}  // namespace muro::view
