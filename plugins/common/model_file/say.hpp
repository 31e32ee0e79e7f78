// SPDX-License-Identifier: MIT
// Texts of messages about model files.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

namespace muro::model_file {

/// Where in a file something stands; lines and columns count from 1, 0 when unknown.
struct Place {
  int line = 0;
  int column = 0;
};

/// The shortest text that reads back as `number`, with a decimal point in every locale.
inline std::string shortest(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// A name or value from the file as it may stand in a message: in backquotes, of bounded length, printable.
inline std::string cited(std::string_view text) {
  constexpr std::size_t most = 60;
  std::string shown(text.substr(0, most));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  // a UTF-8 sequence is not cut in the middle
  if (text.size() > most) {
    while (!shown.empty() && (static_cast<unsigned char>(text[shown.size()]) & 0xc0) == 0x80) shown.pop_back();
    shown += "...";
  }
  return "`" + shown + "`";
}

/// Texts and numbers put together.
template <class... Parts>
std::string say(const Parts&... parts) {
  std::string whole;
  const auto add = [&whole](const auto& part) {
    using T = std::decay_t<decltype(part)>;
    if constexpr (std::is_floating_point_v<T>)
      whole += shortest(part);
    else if constexpr (std::is_integral_v<T>)
      whole += std::to_string(part);
    else
      whole += part;
  };
  (add(parts), ...);
  return whole;
}

/// "`a`, `b`, `c` and 4 more", of anything that begins with a name.
template <class Names>
std::string listed(const Names& names) {
  constexpr std::size_t most = 8;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names)
    if (++count <= most) text += (count > 1 ? ", " : "") + cited(name);
  if (count == 0) return "none";
  return count > most ? say(text, " and ", count - most, " more") : text;
}

}  // namespace muro::model_file
