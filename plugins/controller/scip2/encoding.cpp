// SPDX-License-Identifier: MIT
#include "encoding.hpp"

namespace muro::scip2 {

void ReplyWriter::plain(std::string_view line) { (text_ += line) += '\n'; }

void ReplyWriter::summed(std::string_view line) { ((text_ += line) += sum_of(line)) += '\n'; }

void ReplyWriter::keyed(std::string_view key, std::string_view value) {
  const std::size_t begin = text_.size();
  ((text_ += key) += ':') += value;
  const char sum = sum_of(std::string_view(text_).substr(begin));
  ((text_ += ';') += sum) += '\n';
}

void ReplyWriter::value(std::uint32_t value, int characters) {
  for (int shift = 6 * (characters - 1); shift >= 0; shift -= 6) {
    text_ += char(((value >> shift) & 0x3f) + 0x30);
    if (is_block_ && text_.size() - line_begin_ == block_line_length) end_block_line();
  }
}

void ReplyWriter::begin_block(bool has_sums) {
  is_block_ = true;
  has_sums_ = has_sums;
  line_begin_ = text_.size();
}

void ReplyWriter::end_block() {
  if (text_.size() > line_begin_) end_block_line();
  is_block_ = false;
}

void ReplyWriter::end_block_line() {
  if (has_sums_) text_ += sum_of(std::string_view(text_).substr(line_begin_));
  text_ += '\n';
  line_begin_ = text_.size();
}

}  // namespace muro::scip2
