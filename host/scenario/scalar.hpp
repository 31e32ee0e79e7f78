// SPDX-License-Identifier: MIT
// Values of YAML nodes.
#pragma once

#include <optional>
#include <string>

#include "core/algorithm_setup.hpp"
#include "host/scenario/node.hpp"

namespace muro::host {

/// Returns a value for messages: "`3`", "a list of 2".
std::string quoted(const Node& node);
/// Returns a scalar as a number, if it is one.
std::optional<double> as_number(const Node& node);
/// Returns a scalar, a flat list or a flat map as a parameter of an algorithm; a map becomes a list of texts
/// "key=value". Returns nothing for a nested value.
std::optional<ParameterInput> as_parameter(const Node& node);

}  // namespace muro::host
