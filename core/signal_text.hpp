// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace muro {

/// A text that is built without memory from the heap, locks or locales, so that signal handlers may use it. Text that
/// does not fit is left out.
class SignalText {
 public:
  void add(std::string_view text) {
    for (const char c : text) put(c);
  }
  /// Adds a name from outside: control characters become question marks, and a long name is cut.
  void add_name(std::string_view name) {
    constexpr std::size_t longest = 1024;
    for (const char c : name.substr(0, longest)) put(static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c);
    if (name.size() > longest) add("...");
  }
  void add(std::uint64_t number, unsigned base = 10, unsigned digits = 1) {
    char reversed[64];
    unsigned n = 0;
    for (; number > 0 || n < digits; number /= base) reversed[n++] = "0123456789abcdef"[number % base];
    while (n > 0) put(reversed[--n]);
  }
  /// Adds nanoseconds as seconds with six decimals.
  void add_seconds(std::int64_t ns) {
    if (ns < 0) put('-');
    const auto us = (std::uint64_t(ns < 0 ? -ns : ns) + 500) / 1000;
    add(us / 1'000'000);
    put('.');
    add(us % 1'000'000, 10, 6);
  }
  std::string_view view() const { return {buffer_, size_}; }
  /// Writes the text to a file descriptor; bytes that cannot be written are lost.
  void write_to(int file) const;

 private:
  void put(char c) {
    if (size_ < sizeof buffer_) buffer_[size_++] = c;
  }
  char buffer_[8192];
  std::size_t size_ = 0;
};

}  // namespace muro
