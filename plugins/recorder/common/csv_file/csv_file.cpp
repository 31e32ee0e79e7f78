// SPDX-License-Identifier: MIT
#include "csv_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>

#include "muro/algorithm.hpp"
#include "plugins/common/text/with_scalar.hpp"

namespace muro {

namespace {

/// Returns the decimal seconds at the beginning of a row as ns; -1 when there are none (the header).
std::int64_t time_of(std::string_view row) {
  std::int64_t value = 0;
  int decimals = -1;
  std::size_t i = 0;
  for (; i < row.size() && row[i] != ',' && row[i] != '\r'; ++i) {
    if (row[i] == '.' && decimals < 0) {
      decimals = 0;
    } else if (row[i] >= '0' && row[i] <= '9') {
      value = 10 * value + (row[i] - '0');
      if (decimals >= 0) ++decimals;
    } else {
      return -1;
    }
  }
  if (i == 0) return -1;
  for (int d = std::max(decimals, 0); d < 9; ++d) value *= 10;
  return value;
}

}  // namespace

CsvFile::CsvFile(const std::string& path) : file_(path, {.keep_unpublished = true}) {
  file_.descriptor();
  buffer_.reserve(2 * buffer_bytes);
}

CsvFile::~CsvFile() {
  try {
    if (!failed_) flush();
  } catch (const Error&) {  // a destructor cannot report it
  }
}

void CsvFile::fail(const char* doing) const {
  throw Error("file " + file_.path() + " " + doing + ": " + std::strerror(errno));
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
  if (size_of(type) == 0) return;
  with_scalar(type, [&]<class T>(T number) {
    std::memcpy(&number, value, sizeof number);
    buffer_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  });
}

void CsvFile::time(std::int64_t nanoseconds) {
  separate();
  constexpr std::int64_t second = 1'000'000'000;
  char digits[32];
  buffer_.append(digits, std::to_chars(digits, digits + sizeof digits, nanoseconds / second).ptr);
  std::int64_t rest = nanoseconds % second;
  if (rest != 0) buffer_ += '.';
  for (std::int64_t place = second / 10; rest != 0; rest %= place, place /= 10) buffer_ += char('0' + rest / place);
}

void CsvFile::end_row() {
  buffer_ += "\r\n";
  row_begun_ = false;
  if (buffer_.size() >= buffer_bytes) flush();
}

/// Keeps the complete rows in the file when the disk is full.
void CsvFile::flush() {
  const off_t begin = file_.is_regular() ? lseek(file_.descriptor(), 0, SEEK_CUR) : -1;
  try {
    file_.write(buffer_);
  } catch (const Error&) {
    failed_ = true;
    const off_t end = begin < 0 ? -1 : lseek(file_.descriptor(), 0, SEEK_CUR);
    if (end > begin) {
      const std::size_t whole = std::string_view(buffer_).substr(0, std::size_t(end - begin)).rfind("\r\n");
      const off_t rows = whole == std::string_view::npos ? 0 : off_t(whole) + 2;
      static_cast<void>(ftruncate(file_.descriptor(), begin + rows) == 0);
    }
    buffer_.clear();
    throw;
  }
  buffer_.clear();
}

void CsvFile::cut(off_t end) {
  if (ftruncate(file_.descriptor(), end) != 0 || lseek(file_.descriptor(), end, SEEK_SET) < 0)
    fail("cannot be cut back");
}

void CsvFile::begin_anew() {
  buffer_.clear();
  row_begun_ = failed_ = false;
  if (file_.is_regular()) cut(0);
}

void CsvFile::cut_back(std::int64_t nanoseconds) {
  flush();
  if (!file_.is_regular()) return;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> reader(std::fopen(file_.location().c_str(), "rb"),
                                                               &std::fclose);
  if (!reader) fail("cannot be read back");
  char* row = nullptr;
  std::size_t capacity = 0;
  off_t end = 0;
  while (const ssize_t length = getline(&row, &capacity, reader.get())) {
    if (length < 0 || time_of({row, std::size_t(length)}) >= nanoseconds) break;
    end += length;
  }
  std::free(row);
  cut(end);
}

void CsvFile::publish() {
  if (failed_) return;
  flush();
  try {
    file_.publish();
  } catch (const Error&) {
    failed_ = true;
    throw;
  }
}

}  // namespace muro
