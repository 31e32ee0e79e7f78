// SPDX-License-Identifier: MIT
#include "host/scenario/yaml.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/error.hpp"

namespace muro::host {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t deepest = 100;            // levels of nesting
constexpr std::size_t most_values = 1'000'000;  // values in one scenario, all its files and aliases together

/// Where a text comes from; lines and columns mean something in a file, but not on the command line.
struct Origin {
  std::string name;
  bool is_file;
  Location place_of(const YAML::Mark& mark) const {
    if (!is_file || mark.is_null()) return {name, 0, 0};
    return {name, mark.line + 1, mark.column + 1};
  }
};

/// Counts the values of a scenario, since a short text can stand for very many: aliases of aliases,
/// files that include others many times.
class Budget {
 public:
  void spend(std::size_t values, const Location& at) {
    used_ += values;
    if (used_ > most_values)
      throw SetupError(at.text() + ": the scenario has more than " + std::to_string(most_values) +
                       " values, counting aliases and includes");
  }

 private:
  std::size_t used_ = 0;
};

std::size_t size_of(const Node& n) {
  std::size_t size = 1;
  for (const Node& e : n.list) size += size_of(e);
  for (const auto& [key, value] : n.map) size += size_of(value);
  return size;
}

/// Builds the tree from the events of the parser.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, const Origin& origin, Budget& budget)
      : text_(text), origin_(origin), budget_(budget) {}

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
    const auto known = anchors_.find(anchor);
    if (known == anchors_.end()) fail(mark, "an alias stands inside of what it stands for");
    budget_.spend(known->second.size, origin_.place_of(mark));
    Node n = known->second.node;
    n.location = origin_.place_of(mark);
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
    throw SetupError(origin_.place_of(mark).text() + ": " + text);
  }

  bool written_null(const YAML::Mark& mark) const {
    if (mark.pos < 0 || std::size_t(mark.pos) >= text_.size()) return false;
    const std::string_view rest = std::string_view(text_).substr(std::size_t(mark.pos));
    return rest.front() == '~' || rest.rfind("null", 0) == 0 || rest.rfind("Null", 0) == 0 ||
           rest.rfind("NULL", 0) == 0;
  }

  void begin(Node n, const YAML::Mark& mark, YAML::anchor_t anchor) {
    n.location = origin_.place_of(mark);
    budget_.spend(1, n.location);
    if (open_.size() > deepest) fail(mark, "nested more than " + std::to_string(deepest) + " levels deep");
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
      if (parent.node.find(n.scalar))
        throw SetupError(n.location.text() + ": `" + n.scalar + "` stands here a second time");
      parent.key = n.scalar;
      parent.key_location = n.location;
      parent.has_key = true;
    }
  }

  /// `<<: MAP` or `<<: [MAP, ...]`: keys of these maps where the map has none of its own; earlier maps win.
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
  const Origin& origin_;
  Budget& budget_;
  int documents_ = 0;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Anchored> anchors_;
};

Node parse(const std::string& text, const Origin& origin, Budget& budget) {
  TreeBuilder tree(text, origin, budget);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(tree)) {
    }
  } catch (const YAML::Exception& e) {
    throw SetupError(origin.place_of(e.mark).text() + ": not YAML: " + e.msg);
  }
  return std::move(tree.root);
}

/// Reads files and what they include.
class Loader {
 public:
  /// `asked_at`: "file:line:column: " of the include, or nothing.
  Node load(const std::string& path, const std::string& asked_at) {
    if (std::find(open_.begin(), open_.end(), path) != open_.end())
      throw SetupError(asked_at + "file " + path + " includes itself");
    open_.push_back(path);
    Node n = parse(text_of(path, asked_at), {path, true}, budget_);
    include(n);
    open_.pop_back();
    return n;
  }

 private:
  static std::string text_of(const std::string& path, const std::string& asked_at) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found || code)
      throw SetupError(asked_at + "file " + path +
                       " cannot be read: " + (code ? code.message() : "No such file or directory"));
    if (status.type() == fs::file_type::directory) throw SetupError(asked_at + path + " is a folder, not a file");
    if (status.type() != fs::file_type::regular) throw SetupError(asked_at + path + " is not a regular file");
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    if (!file) throw SetupError(asked_at + "file " + path + " cannot be read: may you read it?");
    return text.str();
  }

  /// Replaces every `include: FILE` by what the file holds; what stands beside it wins.
  void include(Node& n) {
    for (auto& [key, value] : n.map) include(value);
    for (Node& e : n.list) include(e);
    const Node* entry = n.find("include");
    if (!entry) return;
    const Node files = *entry;
    n.erase("include");
    Node base;
    base.kind = Node::Kind::map;
    base.location = n.location;
    for (const Node& file : files.kind == Node::Kind::list ? files.list : std::vector<Node>{files}) {
      if (file.kind != Node::Kind::scalar)
        throw SetupError(file.location.text() + ": `include` is the name of a file, or a list of them");
      const fs::path path = fs::path(file.location.file).parent_path() / file.scalar;
      const Node loaded = load(path.lexically_normal().string(), file.location.text() + ": ");
      if (loaded.kind != Node::Kind::map && loaded.kind != Node::Kind::null)
        throw SetupError(loaded.location.text() + ": an included file must hold `key: value` pairs");
      if (loaded.kind == Node::Kind::map) merge(base, loaded);
    }
    merge(base, n);
    n = base;
  }

  std::vector<std::string> open_;
  Budget budget_;
};

}  // namespace

Node load_yaml(const std::string& path) {
  Node root = Loader().load(path, "");
  if (root.kind == Node::Kind::null) throw SetupError(path + ": the file is empty");
  if (root.kind != Node::Kind::map)
    throw SetupError(root.location.text() + ": a scenario consists of `key: value` pairs");
  return root;
}

Node parse_yaml(const std::string& text, const Location& at) {
  Budget budget;
  Node n;
  n.empty = true;
  if (!text.empty()) n = parse(text, {at.text(), false}, budget);
  const auto place = [&](auto& self, Node& node) -> void {
    node.location = at;
    for (Location& l : node.key_locations) l = at;
    for (auto& [key, value] : node.map) self(self, value);
    for (Node& e : node.list) self(self, e);
  };
  place(place, n);
  return n;
}

}  // namespace muro::host
