// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// The parameters of one request, by name; those that came in order have got their names. All functions throw RpcError
/// (invalid params) that says what is wrong and what is allowed.
class Params {
 public:
  /// `names`: those that the method has, in their order.
  Params(const Json& given, std::span<const std::string_view> names);

  bool has(std::string_view name) const;
  /// Throws when it is not there.
  const Json& at(std::string_view name) const;

  std::string text(std::string_view name) const;
  std::string text(std::string_view name, std::string_view otherwise) const;
  bool flag(std::string_view name, bool otherwise) const;
  double real(std::string_view name, double least, double most) const;
  std::int64_t integer(std::string_view name, std::int64_t least, std::int64_t most) const;
  /// Exactly `count` finite numbers.
  std::vector<double> reals(std::string_view name, std::size_t count) const;
  /// One text, or an array of them.
  std::vector<std::string> texts(std::string_view name, std::size_t most) const;

 private:
  Json values_ = Json::object();
};

/// A finite number within these bounds, in a value from outside; `what` names it.
double real_of(const Json& value, const std::string& what, double least, double most);

}  // namespace muro::jsonrpc
