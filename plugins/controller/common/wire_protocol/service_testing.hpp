// SPDX-License-Identifier: MIT
// A service without streams and simulation, for tests.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "plugins/controller/common/wire_protocol/fault.hpp"
#include "plugins/controller/common/wire_protocol/service.hpp"

namespace muro::wire {

/// A group of numbers from -10 to 10.
class FakeGroup final : public Group {
 public:
  FakeGroup(std::string name, std::size_t size) : Group(std::move(name)), values_(size) {}
  std::size_t size() const override { return values_.size(); }
  void describe(Quantity, std::string& out) const override { out += " " + std::to_string(values_.size()); }
  void read(Quantity quantity, std::vector<double>& out) const override {
    if (quantity == Quantity::effort) throw Fault{FaultCode::not_available, "it has no effort"};
    out = values_;
  }
  void set(Quantity quantity, std::span<const double> values, Origin) override {
    if (quantity != Quantity::standard && quantity != Quantity::position)
      throw Fault{FaultCode::not_available, "it takes positions"};
    if (values.size() != values_.size()) throw Fault{FaultCode::wrong_fields, "not so many"};
    for (const double v : values)
      if (!(v >= -10 && v <= 10)) throw Fault{FaultCode::out_of_range, "not that far"};
    values_.assign(values.begin(), values.end());
  }
  void stop() override { values_.assign(values_.size(), 0); }

 private:
  std::vector<double> values_;
};

/// A service at 100 Hz with the groups `arm` of two numbers and `gripper` of one. Keeps the bytes that it sends.
struct Bench final : Outlet {
  explicit Bench(const Protocol& protocol, double first_report = 0) : service(protocol, "bench 1", groups(), *this) {
    service.set_first_report(first_report);
    service.begin_step(0, 0.01);
    service.connected(1);
  }

  /// Sends a message of client 1; returns the bytes that the client gets at once.
  std::string ask(std::string_view message) {
    sent.clear();
    ++messages;
    service.received(1, message);
    return sent[1];
  }
  /// Returns the bytes that client 1 gets in the next steps.
  std::string run(int steps = 1) {
    sent.clear();
    for (int i = 0; i < steps; ++i) service.begin_step(now += 10'000'000, 0.01);
    return sent[1];
  }

  void send(std::uint32_t client, std::string_view reply) override {
    sent[client] += reply;
    ++replies;
  }
  void send_report(std::uint32_t client, std::string_view report) override { sent[client] += report; }
  void answered() override { ++answers; }
  void disconnect(std::uint32_t client) override { disconnected.push_back(client); }

  static std::vector<std::unique_ptr<Group>> groups() {
    std::vector<std::unique_ptr<Group>> all;
    all.push_back(std::make_unique<FakeGroup>("arm", 2));
    all.push_back(std::make_unique<FakeGroup>("gripper", 1));
    return all;
  }
  Service service;
  std::int64_t now = 0;
  std::map<std::uint32_t, std::string> sent;
  std::uint64_t messages = 0, replies = 0, answers = 0;
  std::vector<std::uint32_t> disconnected;
};

}  // namespace muro::wire
