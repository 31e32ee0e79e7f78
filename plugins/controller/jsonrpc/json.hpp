// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace muro::jsonrpc {

using Json = nlohmann::json;           ///< input: members are found in logarithmic time
using Reply = nlohmann::ordered_json;  ///< output, in the order in which it was built

/// Limit for arrays and objects inside each other; no message of the protocol needs more than a few levels.
inline constexpr int deepest_nesting = 32;

/// Returns nothing when the text is no JSON (RFC 8259, in UTF-8), or nested deeper than that.
std::optional<Json> parse(std::string_view text);

/// Returns the message as text. Replaces bytes that are no UTF-8.
std::string text_of(const Reply& message);
/// Returns the message as a line, with its end.
std::string line_of(const Reply& message);

/// Returns a finite number, which reads back with the same bits, or the text "inf", "-inf" or "nan".
Reply number(double value);

}  // namespace muro::jsonrpc
