// SPDX-License-Identifier: MIT
// Values of properties as JSON, and back.
#pragma once

#include <string>

#include "muro/ext/inspection.hpp"
#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// Whether its values are numbers, names of objects or texts: nothing else can be told.
bool has_values(const LiveProperty& property);

/// How many numbers it has now.
std::size_t numbers_in(const LiveProperty& property);

/// A single number as such, several as an array in the order of the columns; arrays and lists as an array of those.
/// What stands for an object is its name (null: none), what stands for a text is that text.
Reply value_of(const LiveProperty& property, const Inspection& inspection);
Reply value_of_element(const LiveProperty& property, std::uint32_t element, const Inspection& inspection);

/// The bytes of element `element` with `value` in their place: a number, an array of all columns, or an object with
/// some of the columns, where the others stay as they are. Throws RpcError (invalid params) for what does not fit.
std::string bytes_of_element(const LiveProperty& property, std::uint32_t element, const Json& value,
                             const std::string& name);

}  // namespace muro::jsonrpc
