// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace muro::host {

/// The location of a value: a file with line and column (from 1), or an override of the command line.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  bool in_file() const { return line > 0; }
  std::string text() const {
    return in_file() ? file + ":" + std::to_string(line) + ":" + std::to_string(column) : file;
  }
};

/// Positions of the keys of a large map. A copy begins empty, and is filled by the first search.
struct KeyIndex {
  KeyIndex() = default;
  KeyIndex(const KeyIndex&) noexcept {}
  KeyIndex(KeyIndex&&) noexcept = default;
  KeyIndex& operator=(const KeyIndex& other) noexcept {
    if (this != &other) positions.reset();
    return *this;
  }
  KeyIndex& operator=(KeyIndex&&) noexcept = default;
  ~KeyIndex() = default;

  std::unique_ptr<std::unordered_map<std::string, std::size_t>> positions;
};

/// A YAML tree that remembers the location of each value, so that files can be merged and every message can name the
/// location.
struct Node {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  Location location;
  std::string scalar;
  bool quoted = false;    ///< a scalar in quotes is always a text, never a number
  bool empty = false;     ///< a null without any text, not even `~`
  bool replaces = false;  ///< replaces an earlier value of the same key
  std::vector<Node> list;
  std::vector<std::pair<std::string, Node>> map;  ///< in the order of the file
  std::vector<Location> key_locations;            ///< locations of the keys of `map`

  Node();  // these members are out of line, because Node is incomplete where `map` is declared
  Node(const Node&);
  Node(Node&&) noexcept;
  Node& operator=(const Node&);
  Node& operator=(Node&&) noexcept;
  ~Node();

  static constexpr std::size_t none = ~std::size_t(0);
  /// Returns the index of `key` in `map`, or `none`.
  std::size_t position_of(const std::string& key) const;
  const Node* find(const std::string& key) const;
  Node* find(const std::string& key);
  /// Returns the child of that name; adds an empty one when it is missing.
  Node& child(const std::string& key, const Location& at);
  void erase(const std::string& key);
  /// Whether the value switches something off: `off`, `false`, `no`, `none`, `~`.
  bool is_off() const;

 private:
  mutable KeyIndex index_;
};

/// Merges `overlay` into `base`: maps key by key; any other value of `overlay` replaces the value in `base`.
void merge(Node& base, const Node& overlay);

/// Sets one value by its path, "robots.rovers.count=100". `robots.rovers[2-4].motion.use=...` sets it only for some
/// robots of a template. Throws SetupError when the assignment has a different form.
void apply_override(Node& root, const std::string& assignment);

}  // namespace muro::host
