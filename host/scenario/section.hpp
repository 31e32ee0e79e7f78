// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "host/scenario/node.hpp"
#include "muro/geometry.hpp"

namespace muro::host {

/// Collects what is wrong with a scenario, so that all of it can be told at once; each problem once.
class Problems {
 public:
  void add(const Location& at, const std::string& text) { add(at.text() + ": " + text); }
  void add(const std::string& line);
  /// Runs `work`; the lines of what it throws become problems, each behind `prefix`. Whether it threw nothing.
  bool collect(const std::string& prefix, const std::function<void()>& work);
  bool none() const { return lines_.empty(); }
  /// Throws SetupError if there are any.
  void check() const;

 private:
  std::vector<std::string> lines_;
};

/// Reads the keys of one map with checked types. Every mistake goes to `problems` and reading goes on
/// with the default.
class Section {
 public:
  /// `what` names the section in messages: "robot template `rovers`".
  Section(const Node& node, std::string what, Problems& problems);

  const Node* find(const std::string& key);
  bool has(const std::string& key) { return find(key) != nullptr; }
  std::string text(const std::string& key, const std::string& otherwise);
  /// A map or a list; an empty one where there is none, and where the value is of another kind.
  const Node& map(const std::string& key);
  const Node& list(const std::string& key);
  /// Which of `keys` is there, asking for all of them; none, and a problem, when more than one is.
  std::optional<std::string> one_of(const std::vector<std::string>& keys);
  double number(const std::string& key, double otherwise, double least = -1e300, double most = 1e300);
  std::int64_t integer(const std::string& key, std::int64_t otherwise, std::int64_t least, std::int64_t most);
  /// `lengths`: how many numbers are allowed; none: any.
  std::optional<std::vector<double>> numbers(const std::string& key, const std::set<std::size_t>& lengths);
  Vec3 vector(const std::string& key, const Vec3& otherwise);
  /// Keys that nobody asked for become problems with the nearest known one.
  void close();
  /// The keys that nobody asked for so far.
  std::vector<std::pair<std::string, const Node*>> others() const;
  const Location& location() const { return node_.location; }
  Location key_location(const std::string& key) const;
  void problem(const std::string& key, const std::string& text);
  const std::string& what() const { return what_; }

 private:
  const Node& part(const std::string& key, Node::Kind kind, const char* wanted);

  const Node& node_;
  std::string what_;
  Problems& problems_;
  std::vector<std::string> asked_;
};

/// A value for messages: "`3`", "a list of 2".
std::string shown(const Node& n);
/// Whether a name can be part of "robot/object:property": not empty, no `/`, `:`, white space.
bool check_name(const std::string& name, const Location& at, const std::string& what, Problems& problems);
/// "a, b, c".
std::string listed(const std::vector<std::string>& names);
/// A scalar as a number, if it is one.
std::optional<double> as_number(const Node& n);
/// Any value as a parameter of an algorithm; none for maps and mixed lists.
std::optional<ParameterInput> as_parameter(const Node& n);

}  // namespace muro::host
