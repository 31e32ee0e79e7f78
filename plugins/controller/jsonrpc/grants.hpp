// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro::jsonrpc {

/// The changes that clients may make: the patterns of the parameter `write`. * matches any characters, ? matches one.
/// "call:NAME" grants only calls, "object:property" grants only properties.
class Grants {
 public:
  explicit Grants(std::span<const std::string_view> patterns = {}) : patterns_(patterns.begin(), patterns.end()) {}

  /// `name`: "object:property".
  bool may_set(std::string_view name) const;
  bool may_call(std::string_view method) const;
  const std::vector<std::string>& patterns() const { return patterns_; }

 private:
  std::vector<std::string> patterns_;
};

/// Whether a pattern is for calls; `method` is then the text after "call:".
bool is_for_calls(std::string_view pattern, std::string_view& method);

}  // namespace muro::jsonrpc
