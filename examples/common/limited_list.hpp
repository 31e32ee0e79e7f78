// SPDX-License-Identifier: MIT
// A list of limited length, without allocation.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace examples {

/// Holds at most `most` things. Further ones are left out.
template <class T, std::size_t most>
class LimitedList {
 public:
  std::span<const T> all() const { return {things_.data(), count_}; }
  std::span<T> all() { return {things_.data(), count_}; }
  std::size_t size() const { return count_; }
  const T& operator[](std::size_t i) const { return things_[i]; }
  bool is_full() const { return count_ == most; }
  void add(const T& thing) {
    if (count_ < most) things_[count_++] = thing;
  }

 private:
  std::array<T, most> things_{};
  std::size_t count_ = 0;
};

}  // namespace examples
