// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/endpoint.hpp"

#include <unistd.h>

#include <algorithm>

namespace muro::stream {

bool Connections::add(int descriptor, Connection::Descriptor kind) {
  const auto speaking = std::count_if(all_.begin(), all_.end(), [](const auto& c) { return !c->is_silent(); });
  const std::shared_ptr<Client> client = std::uint32_t(speaking) < most_ ? exchange_.connected() : nullptr;
  if (!client) {
    exchange_.count_refused();
    ::close(descriptor);
    return false;
  }
  make_place();
  const auto closed = [this](Connection& connection) {
    std::erase_if(all_, [&](const auto& c) { return c.get() == &connection; });
    if (on_closed) on_closed(connection.was_ended());
  };
  all_.push_back(std::make_shared<Connection>(io_, exchange_, framing_, client, descriptor, kind,
                                              tls_ ? tls_->accept() : nullptr, closed));
  all_.back()->start();
  return true;
}

/// Closes the oldest silent connection when there are too many. A silent client may still be owed an answer.
void Connections::make_place() {
  if (all_.size() < 2 * std::size_t(most_) + 8) return;
  const auto oldest = std::find_if(all_.begin(), all_.end(), [](const auto& c) { return c->is_silent(); });
  (*oldest)->close();
  all_.erase(oldest);
}

void Connections::close() {
  on_closed = nullptr;
  for (const auto& connection : all_) connection->close();
  all_.clear();
}

bool Connections::has_output() const {
  return std::any_of(all_.begin(), all_.end(), [](const auto& c) { return c->has_output(); });
}

void Connections::on_signal() {
  const auto all = all_;  // copy, because some connections may be removed
  for (const auto& connection : all) connection->attend();
}

std::unique_ptr<Endpoint> make_endpoint(const EndpointSetup& setup) {
  switch (setup.address.kind) {
    case Address::Kind::tcp_server:
      return make_tcp_server(setup);
    case Address::Kind::tcp_client:
      return make_tcp_client(setup);
    case Address::Kind::unix_server:
      return make_unix_server(setup);
    case Address::Kind::pty:
      return make_pty(setup);
    case Address::Kind::serial:
      return make_serial(setup);
  }
  return nullptr;
}

}  // namespace muro::stream
