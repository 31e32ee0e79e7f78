// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "budget.hpp"

namespace muro::jsonrpc {

/// A request that was received.
struct Request {
  Reply id;  ///< text, number or null
  bool is_notification = false;
  std::string method;
  Json params;  ///< an array or an object; null: none were given
};

/// The content of one line of a client: a request or a batch of them (JSON-RPC 2.0, sections 4 to 6).
class Message {
 public:
  static constexpr std::size_t largest_batch = 1000;

  /// Reads a line. Entries that are no requests get their answers here.
  explicit Message(std::string_view line);

  /// Returns the request to answer next; null when all are answered.
  const Request* present() const { return requests_.empty() ? nullptr : &requests_.front(); }
  /// Returns the number of requests to answer, including the present one.
  std::size_t left() const { return requests_.size(); }
  /// Returns the limits for the answers.
  Budget& budget() { return budget_; }
  /// Answers the present request. The answer to a notification is not sent.
  void answer(Reply result);
  void fail(const RpcError& error);

  /// Returns the line to send when all are answered; empty when there is no answer.
  std::string reply() const;

 private:
  void add(const Json& entry);
  void add_reply(const Reply& id, const char* what, Reply value);

  bool is_batch_ = false;
  std::deque<Request> requests_;
  Budget budget_;
  std::string replies_;  ///< separated by commas
};

}  // namespace muro::jsonrpc
