// SPDX-License-Identifier: MIT
// Joints that mimic others have no limits of position in muro: a leader takes its followers along. A message reports
// where a model has limits for them that this exceeds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "message.hpp"

namespace muro::model_file {

/// Range of a joint, rad or m.
struct JointRange {
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();

  /// Returns the range of a joint whose position is `offset` + `multiplier` times that of this one.
  JointRange followed(double multiplier, double offset) const {
    if (multiplier == 0) return {offset, offset};
    const double first = offset + multiplier * lower, second = offset + multiplier * upper;
    return {std::min(first, second), std::max(first, second)};
  }
};

/// Returns the message on a joint that follows `leader`, which takes it through `reached`, while its own limits are
/// `own`. Returns nothing if it stays within them, apart from rounding in files.
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
