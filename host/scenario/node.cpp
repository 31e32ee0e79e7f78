// SPDX-License-Identifier: MIT
#include "host/scenario/node.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace muro::host {

namespace fs = std::filesystem;

namespace {

constexpr int deepest = 100;  // levels of nesting

Location place_of(const YAML::Mark& mark, const Location& origin) {
  if (origin.line > 0 || mark.is_null()) return origin;
  return {origin.file, mark.line + 1, mark.column + 1};
}

Node convert(const YAML::Node& y, const Location& origin, int depth) {
  Node n;
  n.location = place_of(y.Mark(), origin);
  if (depth > deepest) throw SetupError(n.location.text() + ": nested more than " + std::to_string(deepest) + " levels deep");
  if (y.IsScalar()) {
    n.kind = Node::Kind::scalar;
    n.scalar = y.Scalar();
    n.quoted = y.Tag() == "!";
  } else if (y.IsSequence()) {
    n.kind = Node::Kind::list;
    for (const YAML::Node& e : y) n.list.push_back(convert(e, origin, depth + 1));
  } else if (y.IsMap()) {
    n.kind = Node::Kind::map;
    for (const auto& entry : y) {
      const Location at = place_of(entry.first.Mark(), origin);
      if (!entry.first.IsScalar()) throw SetupError(at.text() + ": a key must be a word");
      const std::string key = entry.first.Scalar();
      if (n.find(key)) throw SetupError(at.text() + ": `" + key + "` stands here a second time");
      n.map.emplace_back(key, convert(entry.second, origin, depth + 1));
      n.key_locations.push_back(at);
    }
  }
  return n;
}

/// Where both say something, `over` wins; maps are merged.
void merge(Node& under, const Node& over) {
  if (under.kind != Node::Kind::map || over.kind != Node::Kind::map) {
    under = over;
    return;
  }
  for (std::size_t i = 0; i < over.map.size(); ++i) {
    const auto& [key, value] = over.map[i];
    if (Node* known = under.find(key))
      merge(*known, value);
    else
      under.child(key, over.key_locations[i]) = value;
  }
}

Node load(const std::string& path, std::vector<std::string>& open, const std::string& asked_at);

/// Replaces every `include: FILE` by what the file holds; what stands beside it wins.
void include(Node& n, std::vector<std::string>& open) {
  for (auto& [key, value] : n.map) include(value, open);
  for (Node& e : n.list) include(e, open);
  const auto entry = std::find_if(n.map.begin(), n.map.end(), [](const auto& e) { return e.first == "include"; });
  if (entry == n.map.end()) return;
  const Node files = entry->second;
  n.key_locations.erase(n.key_locations.begin() + (entry - n.map.begin()));
  n.map.erase(entry);
  Node base;
  base.kind = Node::Kind::map;
  base.location = n.location;
  for (const Node& file : files.kind == Node::Kind::list ? files.list : std::vector<Node>{files}) {
    if (file.kind != Node::Kind::scalar)
      throw SetupError(file.location.text() + ": `include` is the name of a file, or a list of them");
    const fs::path path = fs::path(file.location.file).parent_path() / file.scalar;
    const Node loaded = load(path.lexically_normal().string(), open, file.location.text() + ": ");
    if (loaded.kind != Node::Kind::map && loaded.kind != Node::Kind::null)
      throw SetupError(loaded.location.text() + ": an included file must hold `key: value` pairs");
    if (loaded.kind == Node::Kind::map) merge(base, loaded);
  }
  merge(base, n);
  n = base;
}

Node load(const std::string& path, std::vector<std::string>& open, const std::string& asked_at) {
  if (std::find(open.begin(), open.end(), path) != open.end())
    throw SetupError(asked_at + "file " + path + " includes itself");
  if (fs::is_directory(path)) throw SetupError(asked_at + path + " is a folder, not a file");
  std::ifstream file(path);
  if (!file) throw SetupError(asked_at + "file " + path + " cannot be read");
  std::stringstream text;
  text << file.rdbuf();
  const Location origin{path, 0, 0};
  open.push_back(path);
  Node n;
  try {
    n = convert(YAML::Load(text.str()), origin, 0);
  } catch (const YAML::Exception& e) {
    throw SetupError(place_of(e.mark, origin).text() + ": not YAML: " + e.msg);
  }
  include(n, open);
  open.pop_back();
  return n;
}

}  // namespace

const Node* Node::find(const std::string& key) const {
  for (const auto& [name, value] : map)
    if (name == key) return &value;
  return nullptr;
}

Node* Node::find(const std::string& key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::child(const std::string& key, const Location& at) {
  kind = Kind::map;
  if (Node* known = find(key)) return *known;
  map.emplace_back(key, Node{});
  key_locations.push_back(at);
  map.back().second.location = at;
  return map.back().second;
}

bool Node::is_off() const {
  return kind == Kind::null ||
         (kind == Kind::scalar && !quoted && (scalar == "off" || scalar == "false" || scalar == "no" || scalar == "none"));
}

Node load_yaml(const std::string& path) {
  std::vector<std::string> open;
  Node root = load(path, open, "");
  if (root.kind == Node::Kind::null) throw SetupError(path + ": the file is empty");
  if (root.kind != Node::Kind::map) throw SetupError(root.location.text() + ": a scenario consists of `key: value` pairs");
  return root;
}

Node parse_yaml(const std::string& text, const Location& at) {
  try {
    Location here = at;
    here.line = 0;
    Node n = convert(YAML::Load(text), Location{here.file, 0, 0}, 0);
    const auto place = [&](auto& self, Node& node) -> void {
      node.location = here;
      for (Location& l : node.key_locations) l = here;
      for (auto& [key, value] : node.map) self(self, value);
      for (Node& e : node.list) self(self, e);
    };
    place(place, n);
    return n;
  } catch (const YAML::Exception& e) {
    throw SetupError(at.text() + ": not YAML: " + e.msg);
  }
}

void apply_override(Node& root, const std::string& assignment) {
  const Location at{"--set " + assignment, 0, 0};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw SetupError(at.text() + ": write path=value, such as robots.rovers.count=100");
  Node* n = &root;
  std::string path = assignment.substr(0, equals);
  while (!path.empty()) {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    const std::string key = path.substr(0, end);
    if (key.empty()) throw SetupError(at.text() + ": the path has an empty part");
    if (n->kind != Node::Kind::map && n->kind != Node::Kind::null)
      throw SetupError(at.text() + ": `" + key + "` has no place inside a " + (n->kind == Node::Kind::list ? "list" : "single value"));
    n = &n->child(key, at);
    path.erase(0, end);
    if (!path.empty() && path.front() == '[') {
      const std::size_t close = path.find(']');
      if (close == std::string::npos) throw SetupError(at.text() + ": `[` is not closed by `]`");
      n = &n->child("variants", at).child(path.substr(1, close - 1), at);
      path.erase(0, close + 1);
    }
    if (!path.empty() && path.front() == '.') {
      path.erase(0, 1);
      if (path.empty()) throw SetupError(at.text() + ": the path has an empty part");
    }
  }
  *n = parse_yaml(assignment.substr(equals + 1), at);
}

}  // namespace muro::host
