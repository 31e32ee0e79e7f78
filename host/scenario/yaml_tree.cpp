// SPDX-License-Identifier: MIT
#include "host/scenario/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>

#include "core/error.hpp"

namespace muro::host {

namespace {

constexpr std::size_t max_depth = 100;         // nesting
constexpr std::size_t max_values = 1'000'000;  // values in one scenario, all its files and aliases together

Location location_of(const YAML::Mark& mark, const TextSource& source) {
  if (!source.is_file || mark.is_null()) return {source.name, 0, 0};
  return {source.name, mark.line + 1, mark.column + 1};
}

std::size_t size_of(const Node& n) {
  std::size_t size = 1;
  for (const Node& e : n.list) size += size_of(e);
  for (const auto& [key, value] : n.map) size += size_of(value);
  return size;
}

/// Builds the tree from the events of the parser.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const TextSource& source, ValueCount& count)
      : text_(text), source_(source), count_(count) {}

  Node root;

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second YAML document begins here; a file holds one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Node n;
    n.empty = !written_null(mark);
    begin(std::move(n), mark, anchor);
    end();
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto anchored = anchors_.find(anchor);
    if (anchored == anchors_.end()) fail(mark, "an alias is used inside of the value that it refers to");
    count_.add(anchored->second.size, location_of(mark, source_));
    Node n = anchored->second.node;
    n.location = location_of(mark, source_);
    begin(std::move(n), mark, YAML::NullAnchor);
    end();
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    Node n;
    n.kind = Node::Kind::scalar;
    n.scalar = value;
    n.quoted = tag == "!" || tag == "tag:yaml.org,2002:str";
    begin(std::move(n), mark, anchor);
    end();
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Node n;
    n.kind = Node::Kind::list;
    begin(std::move(n), mark, anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Node n;
    n.kind = Node::Kind::map;
    begin(std::move(n), mark, anchor);
  }
  void OnMapEnd() override {
    merge_key(open_.back().node);
    end();
  }

 private:
  struct Open {  ///< a value that is not complete yet
    Node node;
    YAML::anchor_t anchor;
    bool has_key = false;  ///< a map that waits for the value of `key`
    std::string key;
    Location key_location;
  };
  struct Anchored {
    Node node;
    std::size_t size;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& text) const {
    throw SetupError(location_of(mark, source_).text() + ": " + text);
  }

  bool written_null(const YAML::Mark& mark) const {
    if (mark.pos < 0 || std::size_t(mark.pos) >= text_.size()) return false;
    const std::string_view rest = std::string_view(text_).substr(std::size_t(mark.pos));
    return rest.front() == '~' || rest.rfind("null", 0) == 0 || rest.rfind("Null", 0) == 0 ||
           rest.rfind("NULL", 0) == 0;
  }

  void begin(Node n, const YAML::Mark& mark, YAML::anchor_t anchor) {
    n.location = location_of(mark, source_);
    count_.add(1, n.location);
    if (open_.size() > max_depth) fail(mark, fmt::format("nested more than {} levels deep", max_depth));
    open_.push_back({std::move(n), anchor, false, {}, {}});
  }

  void end() {
    Node n = std::move(open_.back().node);
    if (open_.back().anchor != YAML::NullAnchor) anchors_[open_.back().anchor] = {n, size_of(n)};
    open_.pop_back();
    if (open_.empty()) {
      root = std::move(n);
    } else if (Open& parent = open_.back(); parent.node.kind == Node::Kind::list) {
      parent.node.list.push_back(std::move(n));
    } else if (parent.has_key) {
      if (n.kind == Node::Kind::null) n.location = parent.key_location;
      parent.node.child(parent.key, parent.key_location) = std::move(n);
      parent.has_key = false;
    } else {
      if (n.kind != Node::Kind::scalar) throw SetupError(n.location.text() + ": a key must be a word");
      // lines of other files look like this; a message must not show them, because they may contain secrets
      if (!n.quoted && n.scalar.find(':') != n.scalar.npos)
        throw SetupError(n.location.text() +
                         ": the key here holds a colon; write `key: value` with a blank behind the colon, or put a key "
                         "that has one in quotes. Is this a YAML file?");
      if (parent.node.find(n.scalar))
        throw SetupError(fmt::format("{}: `{}` stands here a second time", n.location.text(), n.scalar));
      parent.key = n.scalar;
      parent.key_location = n.location;
      parent.has_key = true;
    }
  }

  /// Merges `<<: MAP` or `<<: [MAP, ...]`: adds keys of these maps that the map does not have; earlier maps win.
  void merge_key(Node& n) const {
    const Node* key = n.find("<<");
    if (!key) return;
    const Node from = *key;
    n.erase("<<");
    for (const Node& m : from.kind == Node::Kind::list ? from.list : std::vector<Node>{from}) {
      if (m.kind != Node::Kind::map) throw SetupError(m.location.text() + ": `<<` takes a map, or a list of maps");
      for (std::size_t i = 0; i < m.map.size(); ++i)
        if (!n.find(m.map[i].first)) n.child(m.map[i].first, m.key_locations[i]) = m.map[i].second;
    }
  }

  const std::string& text_;
  const TextSource& source_;
  ValueCount& count_;
  int documents_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
};

}  // namespace

void ValueCount::add(std::size_t values, const Location& at) {
  values_ += values;
  if (values_ > max_values)
    throw SetupError(
        fmt::format("{}: the scenario has more than {} values, counting aliases and includes", at.text(), max_values));
}

Node parse_tree(const std::string& text, const TextSource& source, ValueCount& count) {
  TreeBuilder tree(text, source, count);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(tree)) {
    }
  } catch (const YAML::Exception& e) {
    // the text after a colon is from the file
    const std::string reason = e.msg.substr(0, e.msg.find(':'));
    throw SetupError(fmt::format("{}: not YAML: {}", location_of(e.mark, source).text(), reason));
  }
  return std::move(tree.root);
}

}  // namespace muro::host
