// SPDX-License-Identifier: MIT
// Conversion of values to bytes, for two programs of one build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"

namespace muro::parser_process {

class Writer {
 public:
  /// Appends a value of a type that may be copied byte by byte and holds no address.
  template <class T>
  void value(const T& v) {
    append(&v, sizeof v);
  }
  template <class T>
  void list(std::span<const T> values) {
    value(std::uint64_t(values.size()));
    append(values.data(), values.size_bytes());
  }
  void text(std::string_view t) { list(std::span<const char>(t)); }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<std::byte> bytes_;
};

/// Reads in the order of writing. Throws muro::Error if there is less than requested.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  T value() {
    T v;
    copy(&v, sizeof v);
    return v;
  }
  template <class T>
  std::vector<T> list() {
    const auto size = value<std::uint64_t>();
    if (size > bytes_.size() / sizeof(T)) fail();
    std::vector<T> values(size);
    copy(values.data(), size * sizeof(T));
    return values;
  }
  std::string text() {
    const auto size = value<std::uint64_t>();
    if (size > bytes_.size()) fail();
    std::string text(size, '\0');
    copy(text.data(), size);
    return text;
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  [[noreturn]] static void fail() { throw Error("a message of another process is cut or garbled"); }
  void copy(void* to, std::size_t size) {
    if (size > bytes_.size()) fail();
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
};

}  // namespace muro::parser_process
