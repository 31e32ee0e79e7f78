// SPDX-License-Identifier: MIT
#include "host/scenario/scalar.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace muro::host {

std::string quoted(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::list:
      return fmt::format("a list of {}", node.list.size());
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  Node plain = node;
  plain.quoted = false;
  const bool quoted_number = node.quoted && as_number(plain);
  return fmt::format("`{}`{}", node.scalar, quoted_number ? " in quotes, which makes it a text," : "");
}

std::optional<double> as_number(const Node& node) {
  if (node.kind != Node::Kind::scalar || node.quoted || node.scalar.empty()) return std::nullopt;
  const char* first = node.scalar.data() + (node.scalar.front() == '+' ? 1 : 0);
  const char* last = node.scalar.data() + node.scalar.size();
  double x = 0;
  const auto [end, code] = std::from_chars(first, last, x);
  if (code != std::errc{} || end != last || !std::isfinite(x)) return std::nullopt;
  return x;
}

namespace {

std::optional<ParameterInput> list_parameter(const Node& node) {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  for (const Node& e : node.list) {
    if (e.kind != Node::Kind::scalar) return std::nullopt;
    if (const auto x = as_number(e)) numbers.push_back(*x);
    texts.push_back(e.scalar);
  }
  if (!numbers.empty() && numbers.size() == texts.size()) return numbers;
  return texts;
}

/// Converts a map of single values to a list of texts "key=value".
std::optional<ParameterInput> map_parameter(const Node& node) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : node.map) {
    if (value.kind != Node::Kind::scalar) return std::nullopt;
    texts.push_back(key + "=" + value.scalar);
  }
  return texts;
}

}  // namespace

std::optional<ParameterInput> as_parameter(const Node& node) {
  if (node.kind == Node::Kind::list) return list_parameter(node);
  if (node.kind == Node::Kind::map) return map_parameter(node);
  if (node.kind != Node::Kind::scalar) return std::nullopt;
  const std::string& text = node.scalar;
  if (const auto x = as_number(node)) {
    const bool integer = *x == std::floor(*x) && std::abs(*x) < 1e15 && text.find_first_of(".eE") == std::string::npos;
    if (integer) return static_cast<std::int64_t>(*x);
    return *x;
  }
  if (!node.quoted && (text == "true" || text == "on" || text == "yes")) return true;
  if (!node.quoted && (text == "false" || text == "off" || text == "no")) return false;
  return text;
}

}  // namespace muro::host
