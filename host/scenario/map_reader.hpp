// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "host/scenario/node.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scalar.hpp"
#include "muro/geometry.hpp"

namespace muro::host {

/// Reads the keys of one map with checked types. Every mistake goes to `problems`, and reading continues with the
/// default value. The requested keys are the schema of the map.
class MapReader {
 public:
  /// `what` names the map in messages: "robot template `rovers`".
  MapReader(const Node& node, std::string what, Problems& problems);

  const Node* find(const std::string& key);
  bool has(const std::string& key) { return find(key) != nullptr; }
  std::string text(const std::string& key, const std::string& default_value);
  /// Returns a map or a list; an empty one when the key is missing or its value is of another kind.
  const Node& map(const std::string& key);
  const Node& list(const std::string& key);
  /// Returns the one of `keys` that is present. Returns nothing and adds a problem when none or several are present.
  std::optional<std::string> one_of(const std::vector<std::string>& keys);
  double number(const std::string& key, double default_value, double min = -unbounded, double max = unbounded);
  std::int64_t integer(const std::string& key, std::int64_t default_value, std::int64_t min, std::int64_t max);
  /// Numbers from `min` to `max`. `lengths`: the allowed counts of numbers; empty: any.
  std::optional<std::vector<double>> numbers(const std::string& key, const std::set<std::size_t>& lengths,
                                             double min = -unbounded, double max = unbounded);
  /// Returns three numbers from -limit to limit.
  Vec3 vector(const std::string& key, const Vec3& default_value, double limit);
  /// Adds a problem for each key outside of the schema, with the nearest key of the schema.
  void reject_unknown_keys();
  /// The keys that have not been requested so far.
  std::vector<std::pair<std::string, const Node*>> unread() const;
  const Location& location() const { return node_.location; }
  Location key_location(const std::string& key) const;
  void problem(const std::string& key, const std::string& text);
  const std::string& what() const { return what_; }

 private:
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  const Node& child(const std::string& key, Node::Kind kind, const char* expected);

  const Node& node_;
  std::string what_;
  Problems& problems_;
  std::vector<std::string> schema_;
  std::unordered_set<std::string> asked_;  ///< the keys of schema_
};

}  // namespace muro::host
