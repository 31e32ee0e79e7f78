// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/controller/common/wire_protocol/group.hpp"
#include "plugins/controller/common/wire_protocol/protocol.hpp"

namespace muro::wire {

/// Receives the replies of a service.
class Outlet {
 public:
  virtual void send(std::uint32_t client, std::string_view reply) = 0;
  /// Sends a report. It may be lost when the client is slow.
  virtual void send_report(std::uint32_t client, std::string_view report) = 0;
  /// Reports that a received message was answered completely, or needs no answer.
  virtual void answered() = 0;
  virtual void disconnect(std::uint32_t client) = 0;

 protected:
  ~Outlet() = default;
};

/// Answers clients: turns messages and time into replies. Each message gets one reply, in the order of the messages.
/// Messages after a `wait` are carried out when the wait is over.
class Service {
 public:
  /// `title`: first words of the reply to `info`, "joints 1".
  Service(const Protocol& protocol, std::string title, std::vector<std::unique_ptr<Group>> groups, Outlet& outlet);
  /// Rate (Hz) of the first group that clients get without a request, until they set a report; 0: none.
  void set_first_report(double rate) { first_report_ = rate; }
  /// Throws Error when a group has more numbers than a reply can hold. [start]
  void check_sizes() const;

  /// Begins a step at `time` (ns); the next step is `dt` s later. Sends the answers that are due.
  void begin_step(std::int64_t time, double dt);
  void connected(std::uint32_t client);
  void received(std::uint32_t client, std::string_view message);
  void disconnected(std::uint32_t client);
  /// Handles a jump of time before the next step: waiting clients are answered then, and reports count from there.
  void time_was_set() { is_time_set_ = true; }

  bool is_connected(std::uint32_t client) const;
  bool is_reporting() const;
  std::size_t client_count() const { return sessions_.size(); }

 private:
  struct Report {
    Tag tag;
    std::uint32_t group = 0;
    Quantity quantity = Quantity::standard;
    double period = 0;  ///< ns; 0: none
    std::int64_t begin = 0;
    std::uint64_t count = 0;  ///< reports since `begin`
    std::int64_t due() const { return begin + std::int64_t(period * double(count + 1)); }
  };
  struct Session {
    std::uint32_t client = 0;
    std::optional<Request> waiting;
    std::int64_t due = 0;  ///< end of `waiting`, ns
    std::deque<std::string> behind;
    std::size_t bytes_behind = 0;
    bool is_ended = false;  ///< whether it is to be disconnected
    Report report;
  };

  Session* find(std::uint32_t client);
  void end_wait(Session& s);
  void carry_out_behind(Session& s);
  void take(Session& s, std::string_view message);
  bool carry_out(Session& s, Request& request);
  void start_report(Session& s, const Request& request);
  void send_report(Session& s);
  std::string info(const Request& request) const;
  State state_of(std::uint32_t group, Quantity quantity);

  const Protocol& protocol_;
  const std::string title_;
  const std::vector<std::unique_ptr<Group>> groups_;
  std::vector<std::string> names_;
  Outlet& outlet_;
  double first_report_ = 0;

  std::vector<Session> sessions_;
  std::int64_t now_ = 0;
  double dt_ = 0;
  bool is_time_set_ = false;
  std::vector<double> values_;
  std::string reply_;
};

}  // namespace muro::wire
