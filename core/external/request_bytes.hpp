// SPDX-License-Identifier: MIT
// Requests as bytes, the form in which they are recorded.
#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace muro {

/// Writes values and texts one after the other, in the byte order of the machine.
class RequestWriter {
 public:
  template <class T>
  RequestWriter& value(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&x), sizeof x);
    return *this;
  }
  RequestWriter& text(std::string_view t) {
    value(std::uint64_t(t.size()));
    bytes_ += t;
    return *this;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads them again. A missing value is 0 or empty, and `is_complete` reports it.
class RequestReader {
 public:
  explicit RequestReader(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  T value() {
    T x{};
    if (rest_.size() < sizeof x) {
      complete_ = false;
      return x;
    }
    std::memcpy(&x, rest_.data(), sizeof x);
    rest_.remove_prefix(sizeof x);
    return x;
  }
  std::string_view text() {
    const auto size = value<std::uint64_t>();
    if (size > rest_.size()) complete_ = false;
    const std::string_view t = rest_.substr(0, size);
    rest_.remove_prefix(t.size());
    return t;
  }
  bool is_complete() const { return complete_; }

 private:
  std::string_view rest_;
  bool complete_ = true;
};

}  // namespace muro
