// SPDX-License-Identifier: MIT
#include "host/scenario/yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "host/scenario/yaml_tree.hpp"

namespace muro::host {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t largest_file = 256u << 20;
constexpr std::size_t deepest_include = 30;  // with the nesting in each file, this fits on the stack

/// Reads files and what they include.
class Loader {
 public:
  std::vector<std::string> files;  ///< files that were read

  /// `included_at`: "file:line:column: " of the include, or empty.
  Node load(const std::string& path, const std::string& included_at) {
    if (std::find(open_.begin(), open_.end(), path) != open_.end())
      throw SetupError(included_at + "file " + path + " includes itself");
    if (open_.size() > deepest_include)
      throw SetupError(
          fmt::format("{}file {}: includes are nested more than {} deep", included_at, path, deepest_include));
    open_.push_back(path);
    files.push_back(path);
    Node n = parse_tree(text_of(path, included_at), {path, true}, count_);
    include(n);
    open_.pop_back();
    return n;
  }

 private:
  static std::string text_of(const std::string& path, const std::string& included_at) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (status.type() == fs::file_type::not_found || code)
      throw SetupError(fmt::format("{}file {} cannot be read: {}", included_at, path,
                                   code ? code.message() : "No such file or directory"));
    if (status.type() == fs::file_type::directory) throw SetupError(included_at + path + " is a folder, not a file");
    if (status.type() != fs::file_type::regular) throw SetupError(included_at + path + " is not a regular file");
    const auto fail = [&](const std::string& why) {
      return SetupError(fmt::format("{}file {} cannot be read: {}", included_at, path, why));
    };
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::vector<char> block(1 << 16);
    while (file && text.size() <= largest_file) {
      file.read(block.data(), std::streamsize(block.size()));
      text.append(block.data(), std::size_t(file.gcount()));
    }
    if (text.size() > largest_file) throw fail(fmt::format("it has more than {} MiB", largest_file >> 20));
    // reading stops at the end of the file, or has failed
    if (!file.eof()) throw fail(errno != 0 ? std::strerror(errno) : "the system gives no reason");
    return text;
  }

  /// Replaces every `include: FILE` by the contents of the file; keys beside it override them.
  void include(Node& n) {
    for (auto& [key, value] : n.map) include(value);
    for (Node& e : n.list) include(e);
    const Node* entry = n.find("include");
    if (!entry) return;
    const Node included = *entry;
    n.erase("include");
    Node base;
    base.kind = Node::Kind::map;
    base.location = n.location;
    for (const Node& file : included.kind == Node::Kind::list ? included.list : std::vector<Node>{included}) {
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
  ValueCount count_;
};

}  // namespace

Node load_yaml(const std::string& path, std::vector<std::string>* files) {
  Loader loader;
  Node root = loader.load(path, "");
  if (files) *files = std::move(loader.files);
  if (root.kind == Node::Kind::null) throw SetupError(path + ": the file is empty");
  if (root.kind != Node::Kind::map)
    throw SetupError(root.location.text() + ": a scenario consists of `key: value` pairs");
  return root;
}

Node parse_yaml(const std::string& text, const Location& at) {
  ValueCount count;
  Node n;
  n.empty = true;
  if (!text.empty()) n = parse_tree(text, {at.text(), false}, count);
  const auto relocate = [&](auto& self, Node& node) -> void {
    node.location = at;
    for (Location& l : node.key_locations) l = at;
    for (auto& [key, value] : node.map) self(self, value);
    for (Node& e : node.list) self(self, e);
  };
  relocate(relocate, n);
  return n;
}

}  // namespace muro::host
