// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "muro/base/whole_file.hpp"
#include "muro/value_type.hpp"

namespace muro {

/// A CSV file (RFC 4180) under construction, see WholeFile. PATH.part remains when the file is not published: it is the
/// recording of a failed run. Every function throws muro::Error when the file cannot be opened or written.
class CsvFile {
 public:
  /// Creates PATH.part. Opening a pipe waits for its reader.
  explicit CsvFile(const std::string& path);
  /// Writes the rows that are still in memory, if possible.
  ~CsvFile();
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  /// Adds one field to the present row, quoted where needed.
  void text(std::string_view field);
  /// Adds the shortest decimal number that reads back as the same bits, or nan, inf or -inf.
  void number(Scalar type, const void* value);
  /// Adds `nanoseconds`, 0 or more, as exact decimal seconds.
  void time(std::int64_t nanoseconds);
  void end_row();

  bool is_published() const { return file_.is_published(); }
  /// Has PATH.part removed at the end if the file is not published.
  void discard() { file_.discard(); }
  /// Empties the file if it is a regular file.
  void begin_anew();
  /// Removes the rows at the end whose first field is a time of `nanoseconds` or later, if the file is a regular file.
  void cut_back(std::int64_t nanoseconds);
  /// Writes the rows in memory and gives the file its name. Does nothing after a failure, which has been reported. More
  /// rows may follow; they go to the same file.
  void publish();

 private:
  void separate();
  void flush();
  void cut(off_t end);
  [[noreturn]] void fail(const char* doing) const;

  static constexpr std::size_t buffer_bytes = 1 << 16;
  WholeFile file_;
  std::string buffer_;  ///< complete rows that are not in the file yet, and the present one
  bool row_begun_ = false;
  bool failed_ = false;  ///< a write has failed: the end of the file is missing
};

}  // namespace muro
