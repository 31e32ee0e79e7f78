// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/server.hpp"

#include "muro/algorithm.hpp"

namespace muro::wire {

namespace {

constexpr stream::Limits limits{.output_bytes = 2 << 20};
/// Limit of waiting output (bytes) for reports: above it reports are dropped. The rest of the buffer is for replies.
constexpr std::size_t most_for_reports = 1 << 20;

}  // namespace

Server::Server(Connector& connector, std::uint32_t item, const std::string& name, const Protocol& protocol)
    : protocol_(protocol),
      stream_(connector, name, stream::read_address(connector, item, connector.parameters().texts("stream")),
              protocol.framing(), limits) {}

void Server::set_groups(std::string title, std::vector<std::unique_ptr<Group>> groups, double first_report) {
  service_.emplace(protocol_, std::move(title), std::move(groups), static_cast<Outlet&>(*this));
  service_->set_first_report(first_report);
}

void Server::open() {
  stream_.open();
  service_->check_sizes();
  service_->time_was_set();
}

void Server::restored() { service_->time_was_set(); }

void Server::begin(const Step& step) { service_->begin_step(step.time, step.dt); }

bool Server::serve(const Step& step) {
  bool any = false;
  stream_.begin(step.time);
  while (const stream::Event* const event = stream_.next()) {
    any = true;
    switch (event->kind) {
      case stream::Event::Kind::connected:
        service_->connected(event->client);
        break;
      case stream::Event::Kind::message:
        service_->received(event->client, event->bytes);
        break;
      case stream::Event::Kind::disconnected:
        is_forgotten_ = service_->client_count() == 1;  // what a stream owes is dropped when its last client leaves
        service_->disconnected(event->client);
        is_forgotten_ = false;
        break;
    }
  }
  stream_.set_subscribed(service_->is_reporting());
  return any;
}

void Server::send_report(std::uint32_t client, std::string_view report) {
  stream_.send(client, report, most_for_reports);
}

}  // namespace muro::wire
