// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "muro/key.hpp"

namespace muro {

/// The values of one key: chunks of memory whose addresses never change, filled in order of creation.
class Column {
 public:
  explicit Column(const KeyInfo& key) : key_(key) {}

  const KeyInfo& key() const { return key_; }

  /// Memory for `count` elements side by side, cleared. Between those of different partitions there is a gap:
  /// processors read ahead, and should not read what another thread is working on.
  void* allocate(std::size_t count, std::uint32_t partition) {
    const std::size_t bytes = count * key_.type->size;
    if (!chunks_.empty() && partition != partition_)
      chunks_.back().used = std::min(chunks_.back().used + gap, chunks_.back().size);
    partition_ = partition;
    if (chunks_.empty() || chunks_.back().used + bytes > chunks_.back().size) grow(bytes);
    Chunk& c = chunks_.back();
    void* place = c.memory.get() + c.used;
    c.used += bytes;
    return place;
  }

  /// The used memory of every chunk.
  template <class Visit>
  void each_block(Visit visit) const {
    for (const Chunk& c : chunks_) visit(std::span<std::byte>(c.memory.get(), c.used));
  }

 private:
  static constexpr std::size_t chunk_bytes = 1 << 14;
  static constexpr std::size_t gap = 1 << 12;  ///< processors read no further ahead
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(std::byte* p) const { ::operator delete(p, alignment); }
  };
  struct Chunk {
    std::unique_ptr<std::byte[], Free> memory;
    std::size_t size = 0;
    std::size_t used = 0;
  };

  void grow(std::size_t min_size) {
    const std::size_t size = std::max(min_size, chunk_bytes << std::min<std::size_t>(chunks_.size(), 6));
    auto* memory = static_cast<std::byte*>(::operator new(size, alignment));
    std::fill_n(memory, size, std::byte{0});
    chunks_.push_back({std::unique_ptr<std::byte[], Free>(memory), size, 0});
  }

  KeyInfo key_;
  std::uint32_t partition_ = 0;  ///< of the last element
  std::vector<Chunk> chunks_;
};

}  // namespace muro
