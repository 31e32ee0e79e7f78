// SPDX-License-Identifier: MIT
#include "message.hpp"

namespace muro::jsonrpc {

namespace {

bool can_be_id(const Json& id) { return id.is_string() || id.is_number() || id.is_null(); }

/// Returns why an entry is no request; empty when it is one.
std::string problem_of(const Json& entry) {
  if (!entry.is_object()) return "a request is an object";
  const auto version = entry.find("jsonrpc");
  if (version == entry.end() || *version != "2.0") return "`jsonrpc` must be \"2.0\"";
  const auto method = entry.find("method");
  if (method == entry.end() || !method->is_string()) return "`method` must be a text";
  const auto params = entry.find("params");
  if (params != entry.end() && !params->is_structured()) return "`params` must be an array or an object";
  const auto id = entry.find("id");
  return id == entry.end() || can_be_id(*id) ? "" : "`id` must be a text, a number or null";
}

}  // namespace

Message::Message(std::string_view line) {
  const std::optional<Json> all = parse(line);
  const auto fail_all = [&](Code code, const std::string& message, Reply data = {}) {
    add_reply(nullptr, "error", RpcError{code, message, std::move(data)}.as_json());
  };
  if (!all) {
    fail_all(Code::parse_error, "Parse error",
             "a message is one line of JSON in UTF-8, nested at most " + std::to_string(deepest_nesting) +
                 " deep, with numbers below 1.8e308");
  } else if (!all->is_array()) {
    add(*all);
  } else if (all->empty()) {
    fail_all(Code::invalid_request, "Invalid Request", "a batch has at least one request");
  } else if (all->size() > largest_batch) {
    fail_all(Code::invalid_request, "Invalid Request",
             "a batch has at most " + std::to_string(largest_batch) + " requests");
  } else {
    is_batch_ = true;
    for (const Json& entry : *all) add(entry);
  }
}

void Message::add(const Json& entry) {
  const std::string problem = problem_of(entry);
  const auto id = entry.is_object() ? entry.find("id") : entry.end();
  const bool has_id = entry.is_object() && id != entry.end();
  if (!problem.empty()) {
    const Reply known = has_id && can_be_id(*id) ? Reply(*id) : Reply();
    return add_reply(known, "error", RpcError{Code::invalid_request, "Invalid Request", problem}.as_json());
  }
  Request& request = requests_.emplace_back();
  request.is_notification = !has_id;
  if (has_id) request.id = Reply(*id);
  request.method = entry.at("method").get<std::string>();
  if (const auto params = entry.find("params"); params != entry.end()) request.params = *params;
}

/// Adds a reply as text, which takes a tenth of the memory.
void Message::add_reply(const Reply& id, const char* what, Reply value) {
  std::string text = text_of({{"jsonrpc", "2.0"}, {what, std::move(value)}, {"id", id}});
  try {
    budget_.spend_bytes(text.size());
  } catch (const RpcError& error) {
    text = text_of({{"jsonrpc", "2.0"}, {"error", error.as_json()}, {"id", id}});
  }
  if (!replies_.empty()) replies_ += ',';
  replies_ += text;
}

void Message::answer(Reply result) {
  const Request& request = requests_.front();
  if (!request.is_notification) add_reply(request.id, "result", std::move(result));
  requests_.pop_front();
}

void Message::fail(const RpcError& error) {
  const Request& request = requests_.front();
  if (!request.is_notification) add_reply(request.id, "error", error.as_json());
  requests_.pop_front();
}

std::string Message::reply() const {
  if (replies_.empty()) return "";
  return is_batch_ ? "[" + replies_ + "]\n" : replies_ + "\n";
}

}  // namespace muro::jsonrpc
