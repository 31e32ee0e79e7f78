// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "json.hpp"

namespace muro::jsonrpc {

/// Error codes. The first five are from JSON-RPC 2.0, section 5.1; -32099 to -32000 are free for servers.
enum class Code : int {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal_error = -32603,
  not_granted = -32000,
  not_there = -32001,  ///< no object, property or snapshot has that name
  refused = -32002,    ///< refused by the simulation, which gives the reason
  too_many = -32003,   ///< subscriptions, snapshots, waiting requests, numbers in a reply
  not_authenticated = -32004,
};

/// The reason for a failed request, as its client gets it.
struct RpcError {
  Code code = Code::internal_error;
  std::string message;
  Reply data{};  ///< more details; null: none

  Reply as_json() const;
};

/// Returns `{"did_you_mean": "NAME"}` with the candidate nearest to `wrong`; null when none is near.
Reply nearest_as_data(std::string_view wrong, std::span<const std::string> candidates);

}  // namespace muro::jsonrpc
