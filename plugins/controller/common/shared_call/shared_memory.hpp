// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "plugins/common/child_process/descriptor.hpp"

namespace muro {

/// Memory that several processes have: a file without a name (memfd), mapped.
class SharedMemory {
 public:
  SharedMemory() = default;
  ~SharedMemory() { unmap(); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// Makes the file, without bytes. False, with errno, when the system has none.
  bool create(const char* name);
  /// Gives the file its size, and maps it; the bytes are zero. False, with errno, when it cannot be had.
  bool resize(std::size_t size);
  /// Maps the file that another process has made and sized.
  bool open(int descriptor, std::size_t size);

  /// A copy of this process, made by fork(), gets a copy of the memory for itself. For one memory of a process.
  void keep_from_copies();

  /// The file, not the memory, which stays until the end.
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
