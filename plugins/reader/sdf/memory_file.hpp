// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <string>
#include <string_view>

#include "muro/algorithm.hpp"

namespace muro::sdf {

/// A text that a library can open by a path, without a file on a disk. libsdformat gets included models in this way,
/// because it opens them on its own.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view text) : descriptor_(memfd_create("muro-sdf", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !text.empty()) {
      const ssize_t written = write(descriptor_, text.data(), text.size());
      if (written <= 0) break;
      text.remove_prefix(std::size_t(written));
    }
    if (descriptor_ >= 0 && text.empty()) return;
    if (descriptor_ >= 0) close(descriptor_);
    throw Error("an included model cannot be kept in memory: the system gives no room or no more files");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace muro::sdf
