// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "muro/key.hpp"

namespace muro {

/// The values of one key: chunks of memory whose addresses never change, filled in order of creation.
class Column {
 public:
  explicit Column(const KeyInfo& key) : key_(key) {}

  const KeyInfo& key() const { return key_; }

  /// Returns cleared memory for `count` contiguous elements. There is a gap between elements of different partitions:
  /// processors read ahead, and should not read memory on which another thread works.
  void* allocate(std::size_t count, std::uint32_t partition) {
    const std::size_t bytes = count * key_.type->size;
    if (!chunks_.empty() && partition != partition_)
      chunks_.back().used = std::min(chunks_.back().used + gap, chunks_.back().size);
    partition_ = partition;
    if (chunks_.empty() || chunks_.back().used + bytes > chunks_.back().size) grow(bytes);
    Chunk& c = chunks_.back();
    void* place = c.memory + c.used;
    c.used += bytes;
    return place;
  }

  /// The used memory of every chunk.
  template <class Visit>
  void each_block(Visit visit) const {
    for (const Chunk& c : chunks_) visit(std::span<std::byte>(c.memory, c.used));
  }

 private:
  /// Large, so that only few robots have their values in two chunks: code that serves several robots at once needs
  /// equal distances. Memory that nothing has touched costs nothing.
  static constexpr std::size_t chunk_bytes = 1 << 18;
  static constexpr std::size_t gap = 1 << 12;  ///< processors do not read further ahead than this
  static constexpr std::size_t alignment = 64;
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  struct Chunk {
    std::unique_ptr<void, Free> block;
    std::byte* memory = nullptr;  ///< in `block`, aligned
    std::size_t size = 0;
    std::size_t used = 0;
  };

  void grow(std::size_t min_size) {
    const std::size_t size = std::max(min_size, chunk_bytes << std::min<std::size_t>(chunks_.size(), 2));
    std::size_t room = size + alignment;
    std::unique_ptr<void, Free> block(std::calloc(1, room));
    if (!block) throw std::bad_alloc();
    void* memory = block.get();
    std::align(alignment, size, memory, room);
    chunks_.push_back({std::move(block), static_cast<std::byte*>(memory), size, 0});
  }

  KeyInfo key_;
  std::uint32_t partition_ = 0;  ///< partition of the last element
  std::vector<Chunk> chunks_;
};

}  // namespace muro
