// SPDX-License-Identifier: MIT
#include "csv_file.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>

#include "muro/algorithm.hpp"

namespace muro {

CsvFile::CsvFile(const std::string& path) : path_(path), file_(std::fopen(path.c_str(), "wb")) {
  if (!file_) throw Error("file " + path + " cannot be written: " + std::strerror(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // our own buffer holds whole rows
  buffer_.reserve(2 * buffer_bytes);
}

void CsvFile::separate() {
  if (row_begun_) buffer_ += ',';
  row_begun_ = true;
}

void CsvFile::text(std::string_view field) {
  separate();
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    buffer_ += field;
    return;
  }
  buffer_ += '"';
  for (const char c : field) buffer_.append(c == '"' ? 2 : 1, c);
  buffer_ += '"';
}

void CsvFile::number(Scalar type, const void* value) {
  separate();
  char digits[32];
  const auto put = [&]<class T>(T zero) {
    std::memcpy(&zero, value, sizeof zero);
    buffer_.append(digits, std::to_chars(digits, digits + sizeof digits, zero).ptr);
  };
  switch (type) {
    case Scalar::f64: return put(double{});
    case Scalar::f32: return put(float{});
    case Scalar::i64: return put(std::int64_t{});
    case Scalar::i32: return put(std::int32_t{});
    case Scalar::u64: return put(std::uint64_t{});
    case Scalar::u32: return put(std::uint32_t{});
    case Scalar::u8: return put(std::uint8_t{});
    case Scalar::opaque:
    case Scalar::transient: break;
  }
}

void CsvFile::end_row() {
  buffer_ += "\r\n";
  row_begun_ = false;
  if (buffer_.size() >= buffer_bytes) flush();
}

void CsvFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size())
    throw Error("file " + path_ + " cannot be written: " + std::strerror(errno));
  buffer_.clear();
}

}  // namespace muro
