// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/claim.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cinttypes>
#include <cstddef>
#include <cstdio>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

/// Returns the FNV-1a hash.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

}  // namespace

Claim::~Claim() {
  if (socket_ >= 0) ::close(socket_);
}

bool Claim::take(const std::string& path) {
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0) throw_system_error("cannot open " + quote(path), errno);
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  // A name that begins with a zero byte is in no folder, and lasts as long as its socket.
  const int length =
      std::snprintf(name.sun_path + 1, sizeof name.sun_path - 1, "muro.stream.%016" PRIx64, hash_of(path));
  const auto size = socklen_t(offsetof(sockaddr_un, sun_path) + 1 + std::size_t(length));
  if (::bind(socket_, reinterpret_cast<const sockaddr*>(&name), size) == 0) return true;
  if (errno != EADDRINUSE) throw_system_error("cannot open " + quote(path), errno);
  return false;
}

}  // namespace muro::stream
