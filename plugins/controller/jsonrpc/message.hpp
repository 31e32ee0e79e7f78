// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "budget.hpp"

namespace muro::jsonrpc {

/// A request as it came in.
struct Request {
  Reply id;  ///< text, number or null
  bool is_notification = false;
  std::string method;
  Json params;  ///< an array or an object; null: none were given
};

/// What a client has sent in one line: a request or a batch of them (JSON-RPC 2.0, sections 4 to 6).
class Message {
 public:
  static constexpr std::size_t largest_batch = 1000;

  /// Answers by itself what is no request.
  explicit Message(std::string_view line);

  /// The request to be answered next. Null: all are.
  const Request* present() const { return requests_.empty() ? nullptr : &requests_.front(); }
  /// How many are to be answered, with that one.
  std::size_t left() const { return requests_.size(); }
  /// What the answers may hold.
  Budget& budget() { return budget_; }
  /// Answers the present one; for a notification, the answer is kept to ourselves.
  void answer(Reply result);
  void fail(const RpcError& error);

  /// The line to be sent when all are answered; empty where there is nothing to say.
  std::string reply() const;

 private:
  void add(const Json& entry);
  void add_reply(const Reply& id, const char* what, Reply value);

  bool is_batch_ = false;
  std::deque<Request> requests_;
  Budget budget_;
  std::string replies_;  ///< with commas between them
};

}  // namespace muro::jsonrpc
