// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rpc_error.hpp"

namespace muro::jsonrpc {

/// The parameters of one request, by name; parameters without names get their names here. All functions throw RpcError
/// (invalid params) that says what is wrong and what is allowed.
class Params {
 public:
  /// `names`: parameters of the method, in their order.
  Params(const Json& given, std::span<const std::string_view> names);

  bool has(std::string_view name) const;
  /// Throws when there is no such parameter.
  const Json& at(std::string_view name) const;

  std::string text(std::string_view name) const;
  std::string text(std::string_view name, std::string_view otherwise) const;
  bool flag(std::string_view name, bool otherwise) const;
  double real(std::string_view name, double least, double most) const;
  std::int64_t integer(std::string_view name, std::int64_t least, std::int64_t most) const;
  /// Returns exactly `count` finite numbers.
  std::vector<double> reals(std::string_view name, std::size_t count) const;
  /// Returns one text, or an array of texts.
  std::vector<std::string> texts(std::string_view name, std::size_t most) const;

 private:
  Json values_ = Json::object();
};

/// Returns a finite number within these bounds, from a value of a client. `what`: its name for messages.
double real_of(const Json& value, const std::string& what, double least, double most);

}  // namespace muro::jsonrpc
