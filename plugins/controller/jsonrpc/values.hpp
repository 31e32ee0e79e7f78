// SPDX-License-Identifier: MIT
// Conversion of property values to JSON and back.
#pragma once

#include <string>

#include "muro/ext/inspection.hpp"
#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// Whether the values are numbers, names of objects or texts; no other values can be sent.
bool has_values(const LiveProperty& property);

/// Returns the present number of values.
std::size_t numbers_in(const LiveProperty& property);

/// Form of arrays and lists: as text, or as their bytes in base64.
enum class Encoding : std::uint8_t { text, base64 };
/// Returns the cost in numbers: eight bytes in base64 take about as long as one number as text.
std::size_t cost_of(const LiveProperty& property, Encoding encoding);

/// Returns a single number as a number, several as an array in the order of the columns, arrays and lists as an array
/// of elements. An id of an object gives its name (null: none), an id of a text gives that text. In base64, arrays and
/// lists of numbers are {"type": "float64", "shape": [elements, columns], "base64": little endian, row by row}.
Reply value_of(const LiveProperty& property, const Inspection& inspection, Encoding encoding = Encoding::text);
Reply value_of_element(const LiveProperty& property, std::uint32_t element, const Inspection& inspection);

/// Returns the bytes of element `element` after `value` was put in: a number, an array of all columns, or an object
/// with some columns; the other columns stay. Throws RpcError (invalid params) when the value does not fit.
std::string bytes_of_element(const LiveProperty& property, std::uint32_t element, const Json& value,
                             const std::string& name);

}  // namespace muro::jsonrpc
