// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "muro/toolkit/whole_file.hpp"
#include "muro/value_type.hpp"

namespace muro {

/// A CSV file (RFC 4180) under construction, see WholeFile. PATH.part stays when it is not published: it is the
/// recording of a run that failed. Every function throws muro::Error when the file cannot be opened or written.
class CsvFile {
 public:
  /// Empties PATH.part. Nobody else may be writing it.
  explicit CsvFile(const std::string& path);
  /// What is in memory is still written, if it can be.
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  /// Adds one field to the present row, quoted where needed.
  void text(std::string_view field);
  /// Adds the shortest decimal number that reads back as the same bits; nan, inf or -inf where it is no number.
  void number(Scalar type, const void* value);
  /// Adds `nanoseconds`, 0 or more, as exact decimal seconds.
  void time(std::int64_t nanoseconds);
  void end_row();

  /// Removes the rows at the end whose first field is a time of `nanoseconds` or later, as far as the file lets it.
  void cut_back(std::int64_t nanoseconds);
  /// Writes what is in memory and gives the file its name. More rows may follow; they go to the same file.
  void publish();

 private:
  void separate();
  void flush();
  [[noreturn]] void fail(const char* doing) const;

  static constexpr std::size_t buffer_bytes = 1 << 16;
  WholeFile file_;
  int descriptor_ = -1;
  std::string buffer_;  ///< complete rows that are not in the file yet, and the present one
  bool row_begun_ = false;
};

}  // namespace muro
