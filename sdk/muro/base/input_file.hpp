// SPDX-License-Identifier: MIT
// A reader for any input: a file, a pipe, a device without end.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "muro/algorithm.hpp"

namespace muro {

/// A file that is read once, from its beginning to its end. Errors are muro::Error with path and reason.
class InputFile {
 public:
  /// Opens it. Waits a minute for the first bytes of a pipe.
  explicit InputFile(const std::string& path)
      : InputFile(path, open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {
    constexpr int patience = 60'000;  // ms
    struct stat about {};
    if (descriptor_ < 0 || fstat(descriptor_, &about) != 0) fail(errno);
    if (S_ISDIR(about.st_mode)) fail(EISDIR);
    pollfd first{descriptor_, POLLIN, 0};
    if (S_ISFIFO(about.st_mode) && poll(&first, 1, patience) == 0)
      throw Error(path_ + " is a pipe, to which nobody has written within a minute");
    fcntl(descriptor_, F_SETFL, 0);
  }
  ~InputFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Returns all remaining bytes. Throws Error when there are more than `most` bytes.
  std::string rest(std::size_t most) {
    std::string text(block_, next_);
    while (fill()) {
      text += block_;
      if (text.size() > most) throw Error(path_ + " has more than " + std::to_string(most >> 20) + " MiB");
    }
    block_.clear(), next_ = 0;
    return text;
  }

  /// Reads the next line without its LF. Returns false at the end. Throws Error for a line longer than `longest` bytes.
  bool line(std::string& text, std::size_t longest) {
    text.clear();
    while (next_ < block_.size() || fill()) {
      const std::size_t end = block_.find('\n', next_);
      text.append(block_, next_, end == std::string::npos ? end : end - next_);
      if (text.size() > longest)
        throw Error(path_ + " has a line of more than " + std::to_string(longest >> 20) + " MiB");
      next_ = end == std::string::npos ? block_.size() : end + 1;
      is_cut_ = end == std::string::npos;
      if (!is_cut_) return true;
    }
    return !text.empty();
  }
  /// Whether the last line had no LF: the file ends with it.
  bool is_cut() const { return is_cut_; }

 private:
  /// Owns the descriptor from here on, also when an exception is thrown.
  InputFile(const std::string& path, int descriptor) : path_(path), descriptor_(descriptor) {}

  /// Returns false at the end.
  bool fill() {
    constexpr std::size_t size = std::size_t(1) << 16;
    block_.resize(size);
    next_ = 0;
    ssize_t count = 0;
    do count = read(descriptor_, block_.data(), size);
    while (count < 0 && errno == EINTR);
    if (count < 0) fail(errno);
    block_.resize(std::size_t(count));
    return count > 0;
  }
  [[noreturn]] void fail(int reason) const {
    throw Error(path_ + " cannot be read: " + std::generic_category().message(reason));
  }

  std::string path_;
  int descriptor_ = -1;
  std::string block_;     ///< the block that was read last
  std::size_t next_ = 0;  ///< next byte in it
  bool is_cut_ = false;
};

}  // namespace muro
