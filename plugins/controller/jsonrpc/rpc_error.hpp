// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "json.hpp"

namespace muro::jsonrpc {

/// The first five are those of JSON-RPC 2.0, section 5.1, which leaves -32099 to -32000 to servers.
enum class Code : int {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal_error = -32603,
  not_granted = -32000,
  not_there = -32001,  ///< no object, property or snapshot of that name
  refused = -32002,    ///< by the simulation, which says why
  too_many = -32003,   ///< subscriptions, snapshots, requests that wait, numbers in a reply
  not_authenticated = -32004,
};

/// Why a request fails, as its client is told.
struct RpcError {
  Code code = Code::internal_error;
  std::string message;
  Reply data{};  ///< null: none

  Reply as_json() const;
};

/// `{"did_you_mean": "NAME"}` with the candidate nearest to `wrong`; null where none is near.
Reply nearest_as_data(std::string_view wrong, std::span<const std::string> candidates);

}  // namespace muro::jsonrpc
