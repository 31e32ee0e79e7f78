// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace muro::host {

/// Where something stands: a file with line and column (from 1), or an override of the command line.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  bool in_file() const { return line > 0; }
  std::string text() const {
    return in_file() ? file + ":" + std::to_string(line) + ":" + std::to_string(column) : file;
  }
};

/// A piece of a scenario: a YAML tree that remembers where each part was written, so that files can be
/// merged and every message can name its place.
struct Node {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  Location location;
  std::string scalar;
  bool quoted = false;    ///< a scalar in quotes is a text, never a number
  bool empty = false;     ///< a null of which nothing is written, not even `~`
  bool replaces = false;  ///< stands in the place of an earlier value of the same key
  std::vector<Node> list;
  std::vector<std::pair<std::string, Node>> map;  ///< in the order of writing
  std::vector<Location> key_locations;            ///< of the keys of `map`

  Node();  // and what follows: out of line, since `map` holds pairs of a type that is complete only below
  Node(const Node&);
  Node(Node&&) noexcept;
  Node& operator=(const Node&);
  Node& operator=(Node&&) noexcept;
  ~Node();

  const Node* find(const std::string& key) const;
  Node* find(const std::string& key);
  /// The child of that name, made empty if need be.
  Node& child(const std::string& key, const Location& at);
  void erase(const std::string& key);
  /// `off`, `false`, `no`, `none`, `~`: a switched-off part.
  bool is_off() const;
};

/// Where both say something, `over` wins; maps are merged.
void merge(Node& under, const Node& over);

/// Sets one value by its path, "robots.rovers.count=100". `robots.rovers[2-4].motion.use=...` sets it for
/// some robots of a template only. Throws SetupError when the assignment has no such form.
void apply_override(Node& root, const std::string& assignment);

}  // namespace muro::host
