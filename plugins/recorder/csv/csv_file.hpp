// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "muro/value_type.hpp"

namespace muro {

/// A CSV file (RFC 4180) under way. What is written stands in PATH.part until it is published as PATH, so that PATH
/// is either a whole recording or what was there before. A device or pipe is written at once.
/// Every function throws muro::Error when the file cannot be opened or written.
class CsvFile {
 public:
  /// Begins PATH.part anew. Nobody else may be writing it.
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
  std::string path_, part_;
  int file_ = -1;
  bool published_ = false;  ///< it has its name
  std::string buffer_;      ///< whole rows that are not in the file yet, and the present one
  bool row_begun_ = false;
};

}  // namespace muro
