// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro::scip2 {

/// Returns the check character of a line: the low six bits of the sum of its bytes, plus 0x30.
constexpr char sum_of(std::string_view line) {
  unsigned sum = 0;
  for (const char c : line) sum += static_cast<unsigned char>(c);
  return char((sum & 0x3f) + 0x30);
}

/// Appends replies to a text. The owner of the text has reserved room for the longest one.
class ReplyWriter {
 public:
  explicit ReplyWriter(std::string& text) : text_(text) {}

  /// Writes a line without check character: an echo, or any line of SCIP 1.1.
  void plain(std::string_view line);
  /// Writes a line with its check character: a status.
  void summed(std::string_view line);
  /// Writes "KEY:value" as `KEY:value;S`: the semicolon is not part of the sum.
  void keyed(std::string_view key, std::string_view value);
  /// Ends the reply: an empty line.
  void end() { text_ += '\n'; }

  /// Writes a value in `characters` groups of six bits, the highest first. It must fit: see greatest().
  void value(std::uint32_t value, int characters);
  /// Returns the greatest number that fits into `characters` characters.
  static constexpr std::uint32_t greatest(int characters) { return (1u << (6 * characters)) - 1; }

  /// Starts a block: the next values form lines of 64 characters. `has_sums`: each line has its check character.
  void begin_block(bool has_sums = true);
  void end_block();

 private:
  void end_block_line();

  std::string& text_;
  std::size_t line_begin_ = 0;
  bool is_block_ = false, has_sums_ = true;
};

/// Length of a data line without its check character.
inline constexpr std::size_t block_line_length = 64;

}  // namespace muro::scip2
