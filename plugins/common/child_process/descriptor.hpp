// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace muro {

/// A file descriptor that is closed at the end of its life.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& from) noexcept : number_(from.release()) {}
  Descriptor& operator=(Descriptor&& from) noexcept {
    reset(from.release());
    return *this;
  }
  void reset(int number = -1) {
    if (number_ >= 0) close(number_);
    number_ = number;
  }
  /// Moves it to a number that is none of the standard streams, which may be closed. Returns false, with errno, if
  /// there is no such number.
  bool keep_off_standard_streams() {
    if (number_ >= 0 && number_ <= STDERR_FILENO) reset(fcntl(number_, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    return number_ >= 0;
  }
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int release() {
    const int number = number_;
    number_ = -1;
    return number;
  }
  int number_ = -1;
};

}  // namespace muro
