// SPDX-License-Identifier: MIT
// For recorders and reports: a file is written whole or not at all.
#pragma once

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "muro/algorithm.hpp"

namespace muro {

struct WholeFileOptions {
  bool keep_extension = false;    ///< "film.part.mp4" instead of "film.mp4.part", for writers that go by the extension
  bool keep_unpublished = false;  ///< what was written stays in PATH.part when the file is never published
};

/// A file under construction. Its bytes go to PATH.part, which `publish` renames to PATH, so that PATH is either the
/// complete new file or what it was before. An existing device or pipe is written in place.
/// Write to `stream()`, or let another library write to `location()`. Errors are muro::Error with path and reason.
class WholeFile {
 public:
  /// Opens nothing yet.
  explicit WholeFile(std::string path, WholeFileOptions options = {})
      : path_(std::move(path)), location_(path_), keep_unpublished_(options.keep_unpublished) {
    std::error_code none;
    const std::filesystem::file_status present = std::filesystem::status(path_, none);
    if (std::filesystem::exists(present) && !std::filesystem::is_regular_file(present)) return;
    const std::string extension = options.keep_extension ? std::filesystem::path(path_).extension().string() : "";
    location_.insert(location_.size() - extension.size(), ".part");
  }
  /// Removes what was not published.
  ~WholeFile() {
    std::error_code none;
    if (!keep_unpublished_ && location_ != path_) std::filesystem::remove(location_, none);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  const std::string& path() const { return path_; }
  /// Where the bytes are now: PATH.part; PATH when it is published, a device or a pipe.
  const std::string& location() const { return location_; }

  /// Opens the file, empty, at the first call. Not after publish.
  std::ofstream& stream() {
    if (stream_.is_open()) return stream_;
    errno = 0;
    stream_.open(location_, std::ios::binary);
    if (!stream_) fail(errno);
    return stream_;
  }

  /// Closes the stream, if it was used, and gives the file its name.
  void publish() {
    if (stream_.is_open()) {
      if (!stream_) fail(0);  // an earlier write has failed, whose reason is gone
      errno = 0;
      stream_.close();
      if (!stream_) fail(errno);
    }
    if (location_ == path_) return;
    std::error_code code;
    std::filesystem::rename(location_, path_, code);
    if (code) fail(code.value());
    location_ = path_;
  }

 private:
  [[noreturn]] void fail(int reason) const {
    throw Error("file " + path_ + " cannot be written" +
                (reason == 0 ? "; is there room on the disk?" : ": " + std::generic_category().message(reason)));
  }

  std::string path_, location_;
  bool keep_unpublished_;
  std::ofstream stream_;
};

}  // namespace muro
