// SPDX-License-Identifier: MIT
// Values of YAML nodes.
#pragma once

#include <optional>
#include <string>

#include "core/algorithm_setup.hpp"
#include "host/scenario/node.hpp"

namespace muro::host {

/// A value for messages: "`3`", "a list of 2".
std::string quoted(const Node& node);
/// A scalar as a number, if it is one.
std::optional<double> as_number(const Node& node);
/// A scalar or a flat list as a parameter of an algorithm; none for maps and nested lists.
std::optional<ParameterInput> as_parameter(const Node& node);

}  // namespace muro::host
