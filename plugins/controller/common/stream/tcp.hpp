// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <vector>

#include "plugins/controller/common/stream/endpoint.hpp"

namespace muro::stream {

/// What the host of an address stands for. Throws muro::Error. [setup]
std::vector<asio::ip::tcp::endpoint> resolve(const EndpointSetup& setup, bool is_passive);

/// Small messages leave at once; a client whose machine is gone is noticed within a minute.
void set_tcp_options(int socket);

}  // namespace muro::stream
