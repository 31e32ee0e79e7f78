// SPDX-License-Identifier: MIT
#include "shared_memory.hpp"

#include <sys/mman.h>

namespace muro {

bool SharedMemory::create(const char* name) {
  file_.reset(memfd_create(name, MFD_CLOEXEC));
  return file_.keep_off_standard_streams();
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
