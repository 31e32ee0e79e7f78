// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "muro/value_type.hpp"

namespace muro {

/// A CSV file (RFC 4180) under way. Whole rows only reach the file. Throws muro::Error when it cannot
/// be opened or written.
class CsvFile {
 public:
  /// Creates or empties the file.
  explicit CsvFile(const std::string& path);

  /// Adds one field to the present row, quoted where needed.
  void text(std::string_view field);
  /// Adds the shortest decimal number that reads back as the same bits.
  void number(Scalar type, const void* value);
  void number(double value) { number(Scalar::f64, &value); }
  void end_row();
  void flush();

 private:
  void separate();
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  static constexpr std::size_t buffer_bytes = 1 << 16;
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string buffer_;
  bool row_begun_ = false;
};

}  // namespace muro
