// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::fmu {

/// A line of a CSV file (RFC 4180), read cell by cell. A cell in quotation marks ends on its line; blanks around cells
/// are ignored. Errors are muro::Error: "FILE:LINE:COLUMN: ...".
class TableRow {
 public:
  /// `begin`: number of leading bytes to ignore. Throws Error when the line is not a text.
  TableRow(const std::string& path, std::size_t number, std::string_view line, std::size_t begin = 0)
      : path_(path), line_(line), number_(number), next_(begin), begin_(begin) {
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    for (std::size_t i = begin; i < line_.size(); ++i)
      if (const auto byte = static_cast<unsigned char>(line_[i]); (byte < 0x20 && byte != '\t') || byte == 0x7f)
        fail_at(i, "the character " + quote(line_.substr(i, 1)) + " stands in no text; this is to be a CSV file");
  }

  bool is_blank() const { return line_.find_first_not_of(" \t", next_) == line_.npos; }
  /// Moves to the next cell. Returns false when there is none.
  bool next() {
    if (is_over_) return begin_ = line_.size(), false;
    begin_ = skip_blanks(next_);
    std::size_t end = 0;
    if (begin_ < line_.size() && line_[begin_] == '"') {
      end = skip_blanks(read_quoted());
      if (end < line_.size() && line_[end] != ',') fail_at(end, "a comma must follow the quotation mark");
    } else {
      end = std::min(line_.find(',', begin_), line_.size());
      std::size_t last = end;
      while (last > begin_ && (line_[last - 1] == ' ' || line_[last - 1] == '\t')) --last;
      cell_ = line_.substr(begin_, last - begin_);
    }
    is_over_ = end >= line_.size();
    next_ = end + 1;
    return true;
  }
  const std::string& cell() const { return cell_; }

  /// Throws Error at the cell, or at the end of the line when there is none.
  [[noreturn]] void fail(const std::string& what) const { fail_at(begin_, what); }

 private:
  [[noreturn]] void fail_at(std::size_t place, const std::string& what) const {
    throw Error(path_ + ":" + std::to_string(number_) + ":" + std::to_string(place + 1) + ": " + what);
  }
  std::size_t skip_blanks(std::size_t at) const { return std::min(line_.find_first_not_of(" \t", at), line_.size()); }
  /// Reads a cell in quotation marks; returns the place after the second mark.
  std::size_t read_quoted() {
    cell_.clear();
    for (std::size_t i = begin_ + 1; i < line_.size(); ++i) {
      if (line_[i] != '"') {
        cell_ += line_[i];
      } else if (i + 1 < line_.size() && line_[i + 1] == '"') {
        cell_ += line_[i++];
      } else {
        return i + 1;
      }
    }
    fail("the quotation mark has no second one on its line");
  }

  const std::string& path_;
  std::string_view line_;
  std::size_t number_;
  std::size_t next_, begin_;
  bool is_over_ = false;
  std::string cell_;
};

}  // namespace muro::fmu
