// SPDX-License-Identifier: MIT
#include "rpc_error.hpp"

#include "muro/base/did_you_mean.hpp"

namespace muro::jsonrpc {

Reply RpcError::as_json() const {
  Reply error{{"code", int(code)}, {"message", message}};
  if (!data.is_null()) error["data"] = data;
  return error;
}

Reply nearest_as_data(std::string_view wrong, std::span<const std::string> candidates) {
  const std::vector<std::string> names = nearest_names(wrong, candidates, 1);
  return names.empty() ? Reply() : Reply{{"did_you_mean", names.front()}};
}

}  // namespace muro::jsonrpc
