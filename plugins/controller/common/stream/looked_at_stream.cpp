// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/looked_at_stream.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/in_a_team.hpp"
#include "plugins/controller/common/stream/pty_link.hpp"
#include "plugins/controller/common/stream/system_error.hpp"

namespace muro::stream {

namespace {

/// Returns why no file can be made in the folder of `path`; empty when it can.
std::string problem_of_folder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? "" : reason_at(path, errno);
}

std::string problem_of_socket(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) == 0 && !S_ISSOCK(status.st_mode)) return std::string(no_socket);
  return problem_of_folder(path);
}

std::string problem_of_pty(const std::string& path) {
  const std::string obstacle = PtyLink(path).obstacle();
  if (!obstacle.empty()) return obstacle;
  const std::string folder = problem_of_folder(path);
  return folder.empty() ? "" : "the link to it cannot be made: " + folder;
}

}  // namespace

LookedAtStream::LookedAtStream(const std::string& name, const Address& address) {
  const auto claim = [&](const std::string& what) { return claim_.take(std::to_string(::getpid()) + " " + what); };
  const auto require = [&](const std::string& problem, const std::string& doing) {
    if (!problem.empty()) throw Error("stream " + quote(name) + " cannot " + doing + ": " + problem);
  };
  switch (address.kind) {
    case Address::Kind::tcp_server:
      if (address.port != 0)
        require(claim(address.text()) ? "" : port_is_taken(address.port), "serve on " + address.text());
      break;
    case Address::Kind::unix_server:
      require(claim(address.path) ? problem_of_socket(address.path) : socket_is_taken(),
              "serve on Unix socket " + quote(address.path));
      break;
    case Address::Kind::pty:
      require(claim(address.path) ? problem_of_pty(address.path) : pty_is_taken(),
              "make pseudo-terminal " + quote(address.path));
      break;
    case Address::Kind::tcp_client:
    case Address::Kind::serial:
      break;
  }
}

}  // namespace muro::stream
