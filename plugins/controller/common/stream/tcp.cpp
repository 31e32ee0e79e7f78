// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/tcp.hpp"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::stream {

using asio::ip::tcp;

std::vector<tcp::endpoint> resolve(const EndpointSetup& setup, bool is_passive) {
  const Address& address = setup.address;
  boost::system::error_code error;
  const auto flags =
      is_passive ? tcp::resolver::passive | tcp::resolver::numeric_service : tcp::resolver::numeric_service;
  const auto found =
      tcp::resolver(setup.io.context()).resolve(address.host, std::to_string(address.port), flags, error);
  if (error || found.empty())
    throw Error("stream " + quote(setup.name) + " (" + address.text() + "): no machine of the name " +
                quote(address.host) + " is known: " + error.message() +
                "; write its address, such as 127.0.0.1, or a name that this machine can resolve");
  return {found.begin(), found.end()};
}

void set_tcp_options(int socket) {
  ::fcntl(socket, F_SETFD, FD_CLOEXEC);
  const auto set = [&](int level, int option, int value) { ::setsockopt(socket, level, option, &value, sizeof value); };
  set(IPPROTO_TCP, TCP_NODELAY, 1);
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 30);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 10);
  set(IPPROTO_TCP, TCP_KEEPCNT, 3);
}

}  // namespace muro::stream
