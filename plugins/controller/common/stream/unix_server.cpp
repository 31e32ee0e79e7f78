// SPDX-License-Identifier: MIT
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <optional>

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/stream/acceptor.hpp"
#include "plugins/controller/common/stream/claim.hpp"
#include "plugins/controller/common/stream/in_a_team.hpp"

namespace muro::stream {

namespace {

class UnixServer final : public Endpoint {
 public:
  explicit UnixServer(const EndpointSetup& setup) : setup_(setup) {}

  void open() override {
    const std::string& path = setup_.address.path;
    path.copy(name_.sun_path, sizeof name_.sun_path - 1);
    name_.sun_family = AF_UNIX;
    if (!claim_.take(path)) fail(socket_is_taken());
    remove_stale();
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (socket < 0) fail(system_reason(errno));
    acceptor_.emplace(setup_, socket, [](int) {});
    // The file gets the mode of the socket, so nobody else can open it, not even for a moment.
    struct stat status {};
    if (::fchmod(socket, 0600) != 0 || ::bind(socket, address(), sizeof name_) != 0) fail(reason_at(path, errno));
    if (::chmod(path.c_str(), 0600) != 0 || ::lstat(path.c_str(), &status) != 0 || ::listen(socket, SOMAXCONN) != 0)
      fail(system_reason(errno));
    device_ = status.st_dev;
    file_ = status.st_ino;
    setup_.log(LogLevel::info, "serves on " + setup_.address.text());
  }
  void start() override { acceptor_->accept(); }
  void close() override {
    acceptor_->close();
    struct stat status {};
    const char* const path = name_.sun_path;
    if (::lstat(path, &status) == 0 && status.st_dev == device_ && status.st_ino == file_) ::unlink(path);
  }

 private:
  const sockaddr* address() const { return reinterpret_cast<const sockaddr*>(&name_); }

  /// Removes the socket of a process that has ended; refuses to remove anything else.
  void remove_stale() const {
    struct stat status {};
    if (::lstat(name_.sun_path, &status) != 0) return;
    if (!S_ISSOCK(status.st_mode)) fail(std::string(no_socket));
    const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (probe < 0) fail(system_reason(errno));
    const int error = ::connect(probe, address(), sizeof name_) == 0 ? 0 : errno;
    ::close(probe);
    if (error == ENOENT) return;
    if (error == 0 || error == EAGAIN) fail("another program serves on it" + std::string(another_socket));
    if (error != ECONNREFUSED)
      fail("there is a socket of this name, and whether it is in use is unknown: " + system_reason(error));
    if (::unlink(name_.sun_path) != 0) fail("a socket that was left behind cannot be removed: " + system_reason(errno));
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw Error("stream " + quote(setup_.name) + " cannot serve on Unix socket " + quote(setup_.address.path) + ": " +
                why);
  }

  const EndpointSetup setup_;
  sockaddr_un name_{};
  Claim claim_;
  std::optional<Acceptor> acceptor_;
  dev_t device_ = 0;
  ino_t file_ = 0;
};

}  // namespace

std::unique_ptr<Endpoint> make_unix_server(const EndpointSetup& setup) { return std::make_unique<UnixServer>(setup); }

}  // namespace muro::stream
