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
/// A scalar, a flat list or a flat map as a parameter of an algorithm; a map is a list of texts "key=value". None for
/// what is nested.
std::optional<ParameterInput> as_parameter(const Node& node);

}  // namespace muro::host
