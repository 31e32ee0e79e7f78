// SPDX-License-Identifier: MIT
// Complete files, for recorders and reports: a file is written completely or not at all.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "muro/algorithm.hpp"

namespace muro {

/// Returns the path to which a file of this name is written: absolute, with every symbolic link followed, also a link
/// to a missing file. /dev/stdout and similar names become /proc/PID/fd/NUMBER. `code` is set when it cannot be found.
inline std::filesystem::path target_of(std::filesystem::path path, std::error_code& code) {
  namespace fs = std::filesystem;
  const fs::path own_descriptors = "/proc/" + std::to_string(getpid()) + "/fd";
  path = fs::absolute(path, code);
  for (int links = 0; !code && links < 40; ++links) {
    std::error_code none;
    const fs::path folder = fs::canonical(path.parent_path(), none);
    if (!none) path = folder / path.filename();
    if (path.parent_path() == own_descriptors || !fs::is_symlink(fs::symlink_status(path, none))) return path;
    path = path.parent_path() / fs::read_symlink(path, code);
  }
  if (!code) code = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return path;
}

struct WholeFileOptions {
  bool keep_extension = false;    ///< "film.part.mp4" instead of "film.mp4.part", for writers that need the extension
  bool keep_unpublished = false;  ///< written bytes stay in PATH.part when the file is never published
};

/// A file under construction. Its bytes go to PATH.part, which `publish` renames to PATH, so that PATH is either the
/// complete new file or unchanged. An existing PATH.part is not touched: then PATH.part2, ... is used. A symbolic link
/// stays a link, and its target is written. A device, a pipe, or a file that is open already (/dev/stdout) is written
/// in place. Errors are muro::Error with path and reason.
class WholeFile {
 public:
  /// Opens nothing yet.
  explicit WholeFile(std::string path, WholeFileOptions options = {}) : path_(std::move(path)), options_(options) {}
  /// Removes the file unless it was published.
  ~WholeFile() {
    if (descriptor_ < 0) return;
    if (has_part() && !options_.keep_unpublished) unlink(location_.c_str());
    close(descriptor_);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  const std::string& path() const { return path_; }
  /// Path of the bytes now: PATH.part, or PATH for a published file, a device or a pipe. Another library may write it.
  const std::string& location() { return open(), location_; }
  /// Descriptor for writing, and for reading unless it is a device or pipe.
  int descriptor() { return open(), descriptor_; }
  /// Whether it is a file under construction or a complete one, which has a length; false for a device or a pipe.
  bool is_regular() {
    struct stat about {};
    return fstat(descriptor(), &about) == 0 && S_ISREG(about.st_mode);
  }
  bool is_published() const { return is_published_; }

  /// Writes bytes; the first call creates the file. A pipe waits for its reader.
  void write(std::string_view bytes) {
    open();
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) fail(errno);
      if (written > 0) bytes.remove_prefix(std::size_t(written));
    }
  }

  /// Gives the file its name. More may be written afterwards.
  void publish() {
    open();
    // A copy of the descriptor is closed, because some file systems report a full disk only then.
    if (const int copy = dup(descriptor_); copy >= 0 && close(copy) != 0) fail(errno);
    if (has_part()) {
      if (std::rename(location_.c_str(), target_.c_str()) != 0) fail(errno);
      location_ = target_;
    }
    is_published_ = true;
  }
  /// Removes a file that is not published in the end, whatever the options say.
  void discard() { options_.keep_unpublished = false; }

 private:
  bool has_part() const { return location_ != target_; }

  void open() {
    if (descriptor_ >= 0) return;
    std::error_code code;
    const std::filesystem::path target = target_of(path_, code);
    if (code) fail(code.value());
    target_ = location_ = target.string();
    struct stat present {};
    const bool exists = stat(target_.c_str(), &present) == 0;
    if (is_own_descriptor(target)) {
      descriptor_ = fcntl(std::stoi(target.filename().string()), F_DUPFD_CLOEXEC, 0);
      if (descriptor_ < 0) fail(errno);
    } else if (exists && !S_ISREG(present.st_mode)) {
      if (S_ISDIR(present.st_mode)) fail(EISDIR);
      descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
      if (descriptor_ < 0) fail(errno);
    } else {
      if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);  // rename() does not need this right
      create_part(target);
      if (exists) take_over(present);
    }
  }

  static bool is_own_descriptor(const std::filesystem::path& target) {
    const std::string name = target.filename().string();
    return target.parent_path() == "/proc/" + std::to_string(getpid()) + "/fd" && !name.empty() && name.size() < 9 &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  }

  void create_part(const std::filesystem::path& target) {
    constexpr std::size_t longest_name = 255;
    const std::string extension = options_.keep_extension ? target.extension().string() : "";
    const std::string name = target.filename().string(), stem = name.substr(0, name.size() - extension.size());
    for (int k = 1; k < 1000; ++k) {
      const std::string end = ".part" + (k == 1 ? std::string() : std::to_string(k)) + extension;
      const std::size_t room = longest_name - std::min(longest_name, end.size());
      // a name that is too long itself then fails
      const std::string leaf = name.size() > longest_name ? name + end : stem.substr(0, room) + end;
      location_ = (target.parent_path() / leaf).string();
      descriptor_ = ::open(location_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0) {
        while (flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) {
        }
        return;
      }
      if (errno != EEXIST) fail(errno);
      if (is_locked(location_))
        throw Error("file " + path_ + " is being written by another recorder or run; give each a file of its own");
    }
    throw Error("file " + path_ + " cannot be written: " + target_ + ".part and all names up to .part999 exist; " +
                "remove what runs that did not end have left");
  }

  static bool is_locked(const std::string& path) {
    const int other = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
    if (other < 0) return false;
    const bool locked = flock(other, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(other);
    return locked;
  }

  /// Gives the new file owner and permissions of the file that it replaces, if the user may do so.
  void take_over(const struct stat& present) const {
    const bool given = fchown(descriptor_, present.st_uid, present.st_gid) == 0;
    if (given || present.st_uid == geteuid()) static_cast<void>(fchmod(descriptor_, present.st_mode & 0777));
  }

  [[noreturn]] void fail(int reason) const {
    throw Error("file " + path_ + " cannot be written: " + std::generic_category().message(reason));
  }

  std::string path_;
  WholeFileOptions options_;
  std::string target_, location_;  ///< set once it is open
  int descriptor_ = -1;
  bool is_published_ = false;
};

}  // namespace muro
