// SPDX-License-Identifier: MIT
// Text from outside as it may be shown in a line on a terminal, for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro {

/// The UTF-8 character with which `text` begins, and its number of bytes; size 0: the first byte does not begin one.
struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t size = 0;
};
inline Utf8Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  const std::size_t size = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (size == 0 || size > text.size()) return {};
  std::uint32_t code = size == 1 ? lead : lead & (0x7fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  const bool too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool no_character = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
  return too_long || no_character ? Utf8Character{} : Utf8Character{code, size};
}

/// Whether a character moves the cursor, changes how others are shown, or ends a line.
inline bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// Returns `text` with bytes of control characters, and bytes that are not UTF-8, as \xHH. Characters in `kept` stay.
inline std::string printable(std::string_view text, std::string_view kept = {}) {
  constexpr char digits[] = "0123456789abcdef";
  std::string shown;
  while (!text.empty()) {
    const Utf8Character c = first_character(text);
    const bool fine = c.size > 0 && (!is_control(c.code) || kept.find(text.front()) != kept.npos);
    const std::size_t size = c.size > 0 ? c.size : 1;
    for (const char byte : text.substr(0, size)) {
      const auto value = static_cast<unsigned char>(byte);
      if (fine)
        shown += byte;
      else
        shown += {'\\', 'x', digits[value >> 4], digits[value & 15]};
    }
    text.remove_prefix(size);
  }
  return shown;
}

/// Returns the first `max` bytes of `text`, without a partial character, and "..."; all of a shorter text.
inline std::string shortened(std::string_view text, std::size_t max) {
  if (text.size() <= max) return std::string(text);
  while (max > 0 && (static_cast<unsigned char>(text[max]) & 0xc0) == 0x80) --max;
  return std::string(text.substr(0, max)) + "...";
}

}  // namespace muro
