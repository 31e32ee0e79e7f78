// SPDX-License-Identifier: MIT
#include "shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>

namespace muro {

bool SharedMemory::create(const char* name) {
  constexpr int above_streams = 16;  // numbers that no child is given
  const Descriptor low(memfd_create(name, MFD_CLOEXEC));
  if (low) file_.reset(fcntl(low.get(), F_DUPFD_CLOEXEC, above_streams));
  return bool(file_);
}

bool SharedMemory::resize(std::size_t size) {
  unmap();
  return ftruncate(file_.get(), 0) == 0 && ftruncate(file_.get(), off_t(size)) == 0 && map(file_.get(), size);
}

bool SharedMemory::open(int descriptor, std::size_t size) {
  unmap();
  return map(descriptor, size);
}

bool SharedMemory::map(int descriptor, std::size_t size) {
  void* const data = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (data == MAP_FAILED) return false;
  data_ = data;
  size_ = size;
  return true;
}

void SharedMemory::unmap() {
  if (data_) munmap(data_, size_);
  data_ = nullptr;
  size_ = 0;
}

}  // namespace muro
