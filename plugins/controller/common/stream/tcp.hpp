// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <vector>

#include "plugins/controller/common/stream/endpoint.hpp"

namespace muro::stream {

/// Returns the endpoints for the host of an address. Throws muro::Error. [setup]
std::vector<asio::ip::tcp::endpoint> resolve(const EndpointSetup& setup, bool is_passive);

/// Sets options: small messages are sent at once; a client whose machine is gone is noticed within a minute.
void set_tcp_options(int socket);

}  // namespace muro::stream
