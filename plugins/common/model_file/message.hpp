// SPDX-License-Identifier: MIT
// Texts of messages about model files.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

namespace muro::model_file {

/// The shortest text that reads back as `number`, with a decimal point in every locale.
inline std::string shortest(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// A name or value from the file as it may stand in a message: in backquotes, of bounded length, printable.
inline std::string quote(std::string_view text) {
  constexpr std::size_t max = 60;
  std::string shown(text.substr(0, max));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  // a UTF-8 sequence is not cut in the middle
  if (text.size() > max) {
    while (!shown.empty() && (static_cast<unsigned char>(text[shown.size()]) & 0xc0) == 0x80) shown.pop_back();
    shown += "...";
  }
  return "`" + shown + "`";
}

/// Texts and numbers, one after the other.
template <class... Values>
std::string concat(const Values&... values) {
  std::string result;
  const auto add = [&result](const auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_floating_point_v<T>)
      result += shortest(value);
    else if constexpr (std::is_integral_v<T>)
      result += std::to_string(value);
    else
      result += value;
  };
  (add(values), ...);
  return result;
}

/// "`a`, `b`, `c` and 4 more", of anything that begins with a name.
template <class Names>
std::string quoted_list(const Names& names) {
  constexpr std::size_t max = 8;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names)
    if (++count <= max) text += (count > 1 ? ", " : "") + quote(name);
  if (count == 0) return "none";
  return count > max ? concat(text, " and ", count - max, " more") : text;
}

}  // namespace muro::model_file
