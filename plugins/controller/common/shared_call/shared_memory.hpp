// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "plugins/common/child_process/descriptor.hpp"

namespace muro {

/// Memory that several processes share: a file without a name (memfd), mapped.
class SharedMemory {
 public:
  SharedMemory() = default;
  ~SharedMemory() { unmap(); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// Makes an empty file. Returns false and sets errno when the system has none.
  bool create(const char* name);
  /// Sets the size of the file and maps it; all bytes are zero. Returns false and sets errno when that fails.
  bool resize(std::size_t size);
  /// Maps the file that another process has made and resized.
  bool open(int descriptor, std::size_t size);

  /// A copy of this process, made by fork(), gets a private copy of the memory. Works for one memory of a process.
  void keep_from_copies();

  /// Closes the file. The memory stays mapped.
  void close() { file_.reset(); }

  int descriptor() const { return file_.get(); }
  std::byte* data() const { return static_cast<std::byte*>(data_); }
  std::size_t size() const { return size_; }

 private:
  bool map(int descriptor, std::size_t size);
  void become_private();
  void unmap();

  Descriptor file_;
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace muro
