// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace muro::jsonrpc {

using Json = nlohmann::json;           ///< what comes in: members are found in logarithmic time
using Reply = nlohmann::ordered_json;  ///< what goes out, in the order in which it was put together

/// Arrays and objects within each other; no message of the protocol needs more than a few.
inline constexpr int deepest_nesting = 32;

/// Nothing where the text is no JSON (RFC 8259, in UTF-8), or nested deeper than that.
std::optional<Json> parse(std::string_view text);

/// What is no UTF-8 is replaced.
std::string text_of(const Reply& message);
/// The same as a line, with its end.
std::string line_of(const Reply& message);

/// JSON has no infinite numbers: they are the texts "inf", "-inf" and "nan". All others come back as the same bits.
Reply number(double value);

}  // namespace muro::jsonrpc
