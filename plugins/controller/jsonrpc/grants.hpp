// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro::jsonrpc {

/// What clients may change: the patterns of the parameter `write`, in which * stands for any characters and ? for one.
/// "call:NAME" grants calls, "object:property" grants properties, and neither grants what is of the other kind.
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

/// Whether a pattern is one for calls; `method` is then what follows "call:".
bool is_for_calls(std::string_view pattern, std::string_view& method);

}  // namespace muro::jsonrpc
