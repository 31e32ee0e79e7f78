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

/// How arrays and lists are told: as text, or as the bytes that they are, in base64.
enum class Encoding : std::uint8_t { text, base64 };
/// As how many numbers it counts: eight bytes in base64 take about as long as one number as text.
std::size_t cost_of(const LiveProperty& property, Encoding encoding);

/// A single number as such, several as an array in the order of the columns; arrays and lists as an array of those.
/// What stands for an object is its name (null: none), what stands for a text is that text. In base64, arrays and lists
/// of numbers are {"type": "float64", "shape": [elements, columns], "base64": little endian, row by row}.
Reply value_of(const LiveProperty& property, const Inspection& inspection, Encoding encoding = Encoding::text);
Reply value_of_element(const LiveProperty& property, std::uint32_t element, const Inspection& inspection);

/// The bytes of element `element` with `value` in their place: a number, an array of all columns, or an object with
/// some of the columns, where the others stay as they are. Throws RpcError (invalid params) for what does not fit.
std::string bytes_of_element(const LiveProperty& property, std::uint32_t element, const Json& value,
                             const std::string& name);

}  // namespace muro::jsonrpc
