// SPDX-License-Identifier: MIT
#include "csv_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>

#include "muro/algorithm.hpp"

namespace muro {

namespace {

/// The decimal seconds at the beginning of a row as ns; -1 when there are none (the header).
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

bool is_plain(int descriptor) {
  struct stat about {};
  return fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
}

/// Writes everything; false with errno.
bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

}  // namespace

CsvFile::CsvFile(const std::string& path) : file_(path, {.keep_unpublished = true}) {
  const char* location = file_.location().c_str();
  descriptor_ = open(location, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) descriptor_ = open(location, O_WRONLY | O_CLOEXEC);  // a pipe or device that cannot be read
  if (descriptor_ < 0) fail("cannot be written");
  if (is_plain(descriptor_)) {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const bool busy = errno == EWOULDBLOCK;
      close(descriptor_);
      if (busy) throw Error("file " + path + " is being written by another recorder; give each a file of its own");
      fail("cannot be locked");
    }
    if (ftruncate(descriptor_, 0) != 0) {
      const int reason = errno;
      close(descriptor_);
      errno = reason;
      fail("cannot be written");
    }
  }
  buffer_.reserve(2 * buffer_bytes);
}

CsvFile::~CsvFile() {
  write_all(descriptor_, buffer_);
  close(descriptor_);
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
  const auto put = [&]<class T>(T zero) {
    std::memcpy(&zero, value, sizeof zero);
    buffer_.append(digits, std::to_chars(digits, digits + sizeof digits, zero).ptr);
  };
  switch (type) {
    case Scalar::f64:
      return put(double{});
    case Scalar::f32:
      return put(float{});
    case Scalar::i64:
      return put(std::int64_t{});
    case Scalar::i32:
      return put(std::int32_t{});
    case Scalar::u64:
      return put(std::uint64_t{});
    case Scalar::u32:
      return put(std::uint32_t{});
    case Scalar::u8:
      return put(std::uint8_t{});
    case Scalar::opaque:
    case Scalar::transient:
      break;
  }
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

void CsvFile::flush() {
  if (!write_all(descriptor_, buffer_)) fail("cannot be written");
  buffer_.clear();
}

void CsvFile::cut_back(std::int64_t nanoseconds) {
  flush();
  if (!is_plain(descriptor_)) return;
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
  if (ftruncate(descriptor_, end) != 0 || lseek(descriptor_, end, SEEK_SET) < 0) fail("cannot be cut back");
}

void CsvFile::publish() {
  flush();
  file_.publish();
}

}  // namespace muro
