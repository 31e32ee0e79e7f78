// SPDX-License-Identifier: MIT
#include "host/scenario/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "host/scenario/yaml.hpp"
#include "muro/base/printable.hpp"

namespace muro::host {

Node::Node() = default;
Node::Node(const Node&) = default;
Node::Node(Node&&) noexcept = default;
Node& Node::operator=(const Node&) = default;
Node& Node::operator=(Node&&) noexcept = default;
Node::~Node() = default;

std::size_t Node::position_of(const std::string& key) const {
  constexpr std::size_t large = 32;  // number of keys from which on an index is faster
  if (map.size() < large) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].first == key) return i;
    return none;
  }
  if (!index_.positions) index_.positions = std::make_unique<std::unordered_map<std::string, std::size_t>>();
  auto& positions = *index_.positions;
  for (std::size_t i = positions.size(); i < map.size(); ++i) positions.emplace(map[i].first, i);
  const auto found = positions.find(key);
  return found == positions.end() ? none : found->second;
}

const Node* Node::find(const std::string& key) const {
  const std::size_t at = position_of(key);
  return at == none ? nullptr : &map[at].second;
}

Node* Node::find(const std::string& key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::child(const std::string& key, const Location& at) {
  kind = Kind::map;
  if (Node* present = find(key)) return *present;
  map.emplace_back(key, Node{});
  key_locations.push_back(at);
  map.back().second.location = at;
  return map.back().second;
}

void Node::erase(const std::string& key) {
  const std::size_t at = position_of(key);
  if (at == none) return;
  map.erase(map.begin() + std::ptrdiff_t(at));
  key_locations.erase(key_locations.begin() + std::ptrdiff_t(at));
  index_.positions.reset();
}

bool Node::is_off() const {
  if (kind == Kind::null) return true;
  if (kind != Kind::scalar || quoted) return false;
  std::string word = scalar;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return word == "off" || word == "false" || word == "no" || word == "none";
}

void merge(Node& base, const Node& overlay) {
  if (base.kind != Node::Kind::map || overlay.kind != Node::Kind::map) {
    const bool replaces = base.kind != Node::Kind::null || base.replaces;
    base = overlay;
    base.replaces = base.replaces || replaces;
    return;
  }
  for (std::size_t i = 0; i < overlay.map.size(); ++i) {
    const auto& [key, value] = overlay.map[i];
    merge(base.child(key, overlay.key_locations[i]), value);
  }
}

namespace {

/// One step on the path of an override: a key, or the range of variants after a robot's name.
struct PathStep {
  std::string name;
  bool range = false;
};

std::vector<PathStep> steps_of(std::string path, const std::string& at) {
  constexpr std::size_t most_steps = 100;
  std::vector<PathStep> steps;
  while (true) {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    if (end == 0) throw SetupError(at + ": the path has an empty part");
    steps.push_back({path.substr(0, end)});
    path.erase(0, end);
    if (!path.empty() && path.front() == '[') {
      const std::size_t close = path.find(']');
      if (close == std::string::npos) throw SetupError(at + ": `[` is not closed by `]`");
      if (steps.size() != 2 || steps.front().name != "robots")
        throw SetupError(at +
                         ": `[...]` chooses some robots of a template, so it stands only behind robots.NAME, as in "
                         "robots.rovers[0-4].motion.use=motion.point");
      steps.push_back({path.substr(1, close - 1), true});
      path.erase(0, close + 1);
      if (!path.empty() && path.front() != '.') throw SetupError(at + ": behind `]` comes `.` or the end of the path");
    }
    if (path.empty()) return steps;
    if (steps.size() == most_steps)
      throw SetupError(fmt::format("{}: the path has more than {} parts", at, most_steps));
    path.erase(0, 1);
  }
}

}  // namespace

void apply_override(Node& root, const std::string& assignment) {
  const Location at{"--set " + shortened(printable(assignment), 200), 0, 0};
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw SetupError(at.text() + ": write path=value, such as robots.rovers.count=100");
  Node* n = &root;
  for (const PathStep& step : steps_of(assignment.substr(0, equals), at.text())) {
    if (n->kind != Node::Kind::map && n->kind != Node::Kind::null)
      throw SetupError(fmt::format("{}: `{}` cannot be a key of a {}", at.text(), step.name,
                                   n->kind == Node::Kind::list ? "list" : "single value"));
    if (step.range) n = &n->child("variants", at);
    n = &n->child(step.name, at);
  }
  const bool replaces = n->kind != Node::Kind::null || n->replaces;
  *n = parse_yaml(assignment.substr(equals + 1), at);
  n->replaces = replaces;
}

}  // namespace muro::host
