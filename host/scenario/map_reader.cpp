// SPDX-License-Identifier: MIT
#include "host/scenario/map_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/names.hpp"
#include "muro/base/did_you_mean.hpp"

namespace muro::host {

namespace {

constexpr double largest_number = 1e15;  // limit when no other range is given

/// Returns the range for messages; `{:g}` prints numbers with six digits.
std::string range_text(double min, double max) {
  if (std::isfinite(min) && std::isfinite(max)) return fmt::format(" from {:g} to {:g}", min, max);
  if (std::isfinite(min)) return fmt::format(" of at least {:g}", min);
  return std::isfinite(max) ? fmt::format(" of at most {:g}", max) : "";
}

std::string ordinal(std::size_t n) {
  const bool teen = n / 10 % 10 == 1;
  const char* ending = teen || n % 10 > 3 || n % 10 == 0 ? "th" : (n % 10 == 1 ? "st" : (n % 10 == 2 ? "nd" : "rd"));
  return std::to_string(n) + ending;
}

const Node null_node;

}  // namespace

MapReader::MapReader(const Node& node, std::string what, Problems& problems)
    : node_(node), what_(std::move(what)), problems_(problems) {
  if (node.kind != Node::Kind::map && node.kind != Node::Kind::null)
    problems.add(node.location, fmt::format("{} must be a map of `key: value` pairs, not {}", what_, quoted(node)));
}

const Node* MapReader::find(const std::string& key) {
  if (asked_.insert(key).second) schema_.push_back(key);
  return node_.find(key);
}

Location MapReader::key_location(const std::string& key) const {
  const std::size_t at = node_.position_of(key);
  return at == Node::none ? node_.location : node_.key_locations[at];
}

void MapReader::problem(const std::string& key, const std::string& text) {
  const Node* n = node_.find(key);
  problems_.add(n ? n->location : node_.location, fmt::format("`{}` of {} {}", key, what_, text));
}

std::string MapReader::text(const std::string& key, const std::string& default_value) {
  const Node* n = find(key);
  if (!n) return default_value;
  if (n->kind == Node::Kind::scalar) return n->scalar;
  problem(key, "must be a text, not " + quoted(*n));
  return default_value;
}

const Node& MapReader::child(const std::string& key, Node::Kind kind, const char* expected) {
  const Node* n = find(key);
  if (!n || n->kind == Node::Kind::null) return null_node;
  if (n->kind == kind) return *n;
  problem(key, fmt::format("is {} but must be {}", quoted(*n), expected));
  return null_node;
}

const Node& MapReader::map(const std::string& key) {
  return child(key, Node::Kind::map, "a map of `key: value` pairs");
}
const Node& MapReader::list(const std::string& key) { return child(key, Node::Kind::list, "a list"); }

std::optional<std::string> MapReader::one_of(const std::vector<std::string>& keys) {
  std::vector<std::string> present;
  for (const std::string& k : keys)
    if (has(k)) present.push_back(k);
  if (present.size() == 1 || node_.kind != Node::Kind::map)
    return present.empty() ? std::nullopt : std::optional(present.front());
  if (present.empty() && unread().empty())
    problems_.add(node_.location, fmt::format("{} needs one of: {}", what_, comma_separated(keys)));
  else if (present.empty())
    reject_unknown_keys();
  else
    problems_.add(key_location(present[1]),
                  fmt::format("{} has {}; only one of them is allowed", what_, comma_separated(present)));
  return std::nullopt;
}

double MapReader::number(const std::string& key, double default_value, double min, double max) {
  const Node* n = find(key);
  if (!n) return default_value;
  const auto x = as_number(*n);
  min = std::max(min, -largest_number), max = std::min(max, largest_number);
  if (x && *x >= min && *x <= max) return *x;
  problem(key, fmt::format("is {} but must be a number{}", quoted(*n), range_text(min, max)));
  return default_value;
}

std::int64_t MapReader::integer(const std::string& key, std::int64_t default_value, std::int64_t min,
                                std::int64_t max) {
  const Node* n = find(key);
  if (!n) return default_value;
  const auto x = as_number(*n);
  if (x && *x == std::floor(*x) && *x >= double(min) && *x <= double(max)) return std::int64_t(*x);
  problem(key, fmt::format("is {} but must be a whole number{}", quoted(*n), range_text(double(min), double(max))));
  return default_value;
}

std::optional<std::vector<double>> MapReader::numbers(const std::string& key, const std::set<std::size_t>& lengths,
                                                      double min, double max) {
  const Node* n = find(key);
  if (!n) return std::nullopt;
  const std::string range = range_text(min, max);
  const std::string expected =
      (lengths.empty() ? "a list of numbers" : fmt::format("a list of {} numbers", fmt::join(lengths, " or "))) + range;
  min = std::max(min, -largest_number), max = std::min(max, largest_number);
  if (n->kind != Node::Kind::list || (!lengths.empty() && lengths.count(n->list.size()) == 0)) {
    problem(key, fmt::format("is {} but must be {}", quoted(*n), expected));
    return std::nullopt;
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < n->list.size(); ++i) {
    const Node& e = n->list[i];
    if (const auto x = as_number(e); x && *x >= min && *x <= max)
      values.push_back(*x);
    else
      problems_.add(e.location, fmt::format("`{}` of {} must be {}, but its {} is {}", key, what_, expected,
                                            ordinal(i + 1), quoted(e)));
  }
  if (values.size() != n->list.size()) return std::nullopt;
  return values;
}

Vec3 MapReader::vector(const std::string& key, const Vec3& default_value, double limit) {
  const auto v = numbers(key, {3}, -limit, limit);
  return v ? Vec3((*v)[0], (*v)[1], (*v)[2]) : default_value;
}

std::vector<std::pair<std::string, const Node*>> MapReader::unread() const {
  std::vector<std::pair<std::string, const Node*>> all;
  for (const auto& [key, value] : node_.map)
    if (asked_.count(key) == 0) all.emplace_back(key, &value);
  return all;
}

void MapReader::reject_unknown_keys() {
  std::vector<std::string> allowed = schema_;
  std::sort(allowed.begin(), allowed.end());
  for (const auto& [key, unused] : unread())
    problems_.add(key_location(key), fmt::format("{} has no key `{}`{}; allowed: {}", what_, key,
                                                 did_you_mean(key, allowed), comma_separated(allowed)));
}

}  // namespace muro::host
