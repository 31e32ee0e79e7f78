// SPDX-License-Identifier: MIT
#include "shared_memory.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>

namespace muro {

namespace {

SharedMemory* kept_from_copies = nullptr;

}  // namespace

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

void SharedMemory::keep_from_copies() {
  kept_from_copies = this;
  static const int registered = pthread_atfork(nullptr, nullptr, [] {
    if (kept_from_copies) kept_from_copies->become_private();
  });
  static_cast<void>(registered);
}

/// Runs in the copy, between fork() and its return: may make only system calls.
void SharedMemory::become_private() {
  void* const copy = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (copy == MAP_FAILED) _exit(127);
  std::memcpy(copy, data_, size_);
  if (mremap(copy, size_, size_, MREMAP_MAYMOVE | MREMAP_FIXED, data_) == MAP_FAILED) _exit(127);
}

void SharedMemory::unmap() {
  if (kept_from_copies == this) kept_from_copies = nullptr;
  if (data_) munmap(data_, size_);
  data_ = nullptr;
  size_ = 0;
}

}  // namespace muro
