// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace muro::model_file {

/// Sets sizes that are too small for any shape to 0, which is no size. `name`: of the element or attribute.
void drop_tiny_sizes(std::string_view name, std::span<double> values);

/// Returns what is wrong with numbers of the element or attribute `name` of a URDF or SDFormat file ("mass", "xyz",
/// "pose"), by the ranges of muro/base/limits.hpp. It completes a sentence that begins with the text. Empty: nothing
/// is wrong, or no range is known.
std::string range_problem(std::string_view name, std::span<const double> values);

}  // namespace muro::model_file
