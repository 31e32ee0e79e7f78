// SPDX-License-Identifier: MIT
#include "json.hpp"

#include <cmath>

namespace muro::jsonrpc {

namespace {

/// Checks the nesting before anything is parsed. The text need not be JSON.
bool is_nested_too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_nesting) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace

std::optional<Json> parse(std::string_view text) {
  if (is_nested_too_deep(text)) return std::nullopt;
  Json value = Json::parse(text, nullptr, false);
  if (value.is_discarded()) return std::nullopt;
  return value;
}

std::string text_of(const Reply& message) { return message.dump(-1, ' ', false, Reply::error_handler_t::replace); }

std::string line_of(const Reply& message) { return text_of(message) + "\n"; }

Reply number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

}  // namespace muro::jsonrpc
