// SPDX-License-Identifier: MIT
// The method by which clients give the token of a server.
#include "method.hpp"
#include "token.hpp"

namespace muro::jsonrpc {

void authenticate(Call& c) {
  const std::string given = c.params.text("token");
  const bool may_try = c.client.failures < Conversation::most_failures;  // one batch may hold all attempts
  if (!c.served.token.empty() && !(may_try && is_same_token(given, c.served.token))) {
    ++c.client.failures;
    throw RpcError{Code::not_authenticated, "this is not the token"};
  }
  c.client.is_trusted = true;
  c.answer({{"authenticated", true}});
}

}  // namespace muro::jsonrpc
