// SPDX-License-Identifier: MIT
#include "grants.hpp"

#include "plugins/common/text/glob.hpp"

namespace muro::jsonrpc {

bool is_for_calls(std::string_view pattern, std::string_view& method) {
  constexpr std::string_view calls = "call:";
  if (!pattern.starts_with(calls)) return false;
  method = pattern.substr(calls.size());
  return true;
}

bool Grants::may_set(std::string_view name) const {
  std::string_view method;
  for (const std::string& pattern : patterns_)
    if (!is_for_calls(pattern, method) && matches(pattern, name)) return true;
  return false;
}

bool Grants::may_call(std::string_view method) const {
  std::string_view granted;
  for (const std::string& pattern : patterns_)
    if (is_for_calls(pattern, granted) && matches(granted, method)) return true;
  return false;
}

}  // namespace muro::jsonrpc
