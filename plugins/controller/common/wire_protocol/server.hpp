// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "muro/step.hpp"
#include "plugins/controller/common/stream/stream.hpp"
#include "plugins/controller/common/wire_protocol/service.hpp"

namespace muro::wire {

/// One item of a controller, with its stream.
class Server final : private Outlet {
 public:
  /// `name`: name of the stream, "rover_0/joints". [setup]
  Server(Connector& connector, std::uint32_t item, const std::string& name, const Protocol& protocol);
  ~Server() = default;

  /// Sets the groups to serve; see Service. `first_report`: Hz. [setup]
  void set_groups(std::string title, std::vector<std::unique_ptr<Group>> groups, double first_report);
  void open();  ///< [start]
  void restored();
  void finish() { stream_.finish(); }

  /// Sends the answers that are due. [step]
  void begin(const Step& step);
  /// Takes received messages; in lockstep waits for one while the client owes one. False: there was none. [step]
  bool serve(const Step& step);
  bool is_lockstep() const { return !stream_.address().lockstep.empty(); }
  const Service& service() const { return *service_; }

 private:
  void send(std::uint32_t client, std::string_view reply) override { stream_.send(client, reply); }
  void send_report(std::uint32_t client, std::string_view report) override;
  void answered() override {
    if (!is_forgotten_) stream_.answered();
  }
  void disconnect(std::uint32_t client) override { stream_.disconnect(client); }

  const Protocol& protocol_;
  stream::Stream stream_;
  std::optional<Service> service_;
  bool is_forgotten_ = false;  ///< whether lockstep no longer counts the messages that are answered now
};

}  // namespace muro::wire
