// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/pty_link.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

constexpr std::string_view terminals = "/dev/pts/";
/// A second spelling of this folder. It marks the links that muro has made.
constexpr std::string_view our_terminals = "/dev/./pts/";

std::optional<std::string> target_of(const std::string& link) {
  char target[4096];
  const ssize_t size = ::readlink(link.c_str(), target, sizeof target);
  if (size < 0) return std::nullopt;
  return std::string(target, std::size_t(size));
}

}  // namespace

std::string PtyLink::obstacle() const {
  struct stat status {};
  if (::lstat(path_.c_str(), &status) != 0) return errno == ENOENT ? "" : system_reason(errno);
  const auto target = target_of(path_);
  if (!target) return "there is a file of this name that is no link to a terminal; remove it or choose another name";
  if (target->starts_with(our_terminals)) return {};
  const bool is_dangling = ::stat(path_.c_str(), &status) != 0 && errno == ENOENT;
  if (target->starts_with(terminals) && is_dangling) return {};
  return "there is a link of this name to " + quote(*target) +
         ", which muro has not made; remove it or choose another "
         "name";
}

int PtyLink::point_to(const std::string& terminal) {
  target_ = std::string(our_terminals) + terminal.substr(terminals.size());
  const std::string next = path_ + "." + std::to_string(::getpid()) + ".new";
  ::unlink(next.c_str());
  if (::symlink(target_.c_str(), next.c_str()) != 0) return errno;
  if (::rename(next.c_str(), path_.c_str()) == 0) return 0;
  const int error = errno;
  ::unlink(next.c_str());
  return error;
}

void PtyLink::remove() const {
  if (!target_.empty() && target_of(path_) == target_) ::unlink(path_.c_str());
}

}  // namespace muro::stream
