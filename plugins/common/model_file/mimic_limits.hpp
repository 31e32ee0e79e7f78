// SPDX-License-Identifier: MIT
// Joints that mimic others have no limits of position in muro: a leader takes its followers along. A message says where
// a model has limits for them that this passes.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "message.hpp"

namespace muro::model_file {

/// rad or m.
struct JointRange {
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();

  /// Where a joint goes whose position is `offset` + `multiplier` times one of these.
  JointRange followed(double multiplier, double offset) const {
    if (multiplier == 0) return {offset, offset};
    const double first = offset + multiplier * lower, second = offset + multiplier * upper;
    return {std::min(first, second), std::max(first, second)};
  }
};

/// What to say of a joint that follows `leader`, which takes it through `reached`, where its own limits are `own`;
/// nothing where it stays within them, to what rounding in files leaves.
inline std::optional<std::string> passed_mimic_limits(const std::string& joint, const std::string& leader,
                                                      const JointRange& reached, const JointRange& own) {
  constexpr double rounding = 1e-3;  // rad or m
  if (reached.lower >= own.lower - rounding && reached.upper <= own.upper + rounding) return std::nullopt;
  const auto end = [](double q) { return std::isfinite(q) ? shortest(q) : q < 0 ? "-infinity" : "infinity"; };
  return concat("joint ", quote(joint), " mimics ", quote(leader), ", which takes it from ", end(reached.lower), " to ",
                end(reached.upper), ", beyond its own limits ", end(own.lower), " to ", end(own.upper),
                "; it goes there, since mimic joints have the limits of their leaders alone. Mend multiplier, offset "
                "or limits");
}

}  // namespace muro::model_file
