// SPDX-License-Identifier: MIT
// Values of properties as numbers and as text.
#pragma once

#include <string>

#include "muro/ext/inspection.hpp"

namespace muro::view {

/// A scalar of a property, by its number among all elements' scalars.
struct Scalars {
  explicit Scalars(const LiveProperty& p) : property(p) {}

  /// How many; 0 for what has none (opaque values).
  std::uint32_t size() const;
  /// "x", "[3]", "[3].x"; empty for a single number.
  std::string label(std::uint32_t i) const;
  double get(std::uint32_t i) const;
  /// Leaves the property as it is, and returns false, when its value would be out of range (muro/base/limits.hpp).
  /// An orientation stays of length 1.
  bool set(std::uint32_t i, double value) const;

  const LiveProperty& property;
};

/// Everything in a line, shortened: "1.25, -0.5, 3"; for what has no numbers, what it is.
std::string summary_of(const LiveProperty& property, const Inspection& simulation);

}  // namespace muro::view
