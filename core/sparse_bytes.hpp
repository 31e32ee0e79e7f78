// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace muro {

/// A copy of bytes that leaves out pieces that are zero; most of a state is zero at its start.
class SparseBytes {
 public:
  explicit SparseBytes(std::span<const std::byte> bytes) : size_(bytes.size()) {
    std::size_t kept = 0;
    for (std::size_t begin = 0; begin < size_; begin += piece) {
      const auto part = bytes.subspan(begin, std::min(piece, size_ - begin));
      if (is_zero(part)) continue;
      begins_.push_back(begin);
      kept += part.size();
    }
    bytes_.reserve(kept);
    for (const std::size_t begin : begins_) {
      const auto part = bytes.subspan(begin, std::min(piece, size_ - begin));
      bytes_.insert(bytes_.end(), part.begin(), part.end());
    }
  }
  /// Size of the copied bytes.
  std::size_t size() const { return size_; }
  /// Copies the bytes to `to`, which has this size.
  void copy_to(std::span<std::byte> to) const {
    std::fill(to.begin(), to.end(), std::byte{0});
    auto from = bytes_.begin();
    for (const std::size_t begin : begins_) {
      const auto count = std::ptrdiff_t(std::min(piece, size_ - begin));
      std::copy(from, from + count, to.begin() + std::ptrdiff_t(begin));
      from += count;
    }
  }

 private:
  static constexpr std::size_t piece = 512;

  /// Compares each byte with the byte before it; the first is zero.
  static bool is_zero(std::span<const std::byte> part) {
    return part[0] == std::byte{0} && std::memcmp(part.data(), part.data() + 1, part.size() - 1) == 0;
  }

  std::size_t size_;
  std::vector<std::size_t> begins_;  ///< begins of the pieces that are not zero
  std::vector<std::byte> bytes_;     ///< the bytes of these pieces, one after the other
};

}  // namespace muro
