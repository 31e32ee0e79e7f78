// SPDX-License-Identifier: MIT
#include "core/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/algorithm_setup.hpp"
#include "core/error.hpp"
#include "core/plugin_library.hpp"
#include "describe/describe.hpp"
#include "muro/base/did_you_mean.hpp"

namespace muro {

namespace fs = std::filesystem;

namespace {

/// Whether two paths lead to one file, or to files with the same bytes: a copy of a plugin does not compete with it.
bool is_same_library(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  if (fs::file_size(a, error) != fs::file_size(b, error) || error) return false;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

bool reads(const CatalogEntry& entry, const std::string& extension) {
  return std::find(entry.extensions.begin(), entry.extensions.end(), extension) != entry.extensions.end();
}

/// Returns what a library offers under a name or for a type of files. Throws SetupError.
CatalogEntry entry_of(const std::string& library, const std::string& name) {
  std::error_code none;
  if (!fs::exists(library, none)) throw SetupError("there is no such file");
  if (!library.ends_with(".so") || !fs::is_regular_file(library, none))
    throw SetupError("it is no plugin, which is a file NAME.so with a description NAME.muro.json beside it");
  std::vector<std::string> offered;
  for (CatalogEntry& entry : read_description_of(library)) {
    if (entry.id == name || reads(entry, name)) return std::move(entry);
    offered.push_back(entry.id);
  }
  throw SetupError(fmt::format("it offers {}", fmt::join(offered, ", ")));
}

/// Returns what a user can do about several plugins for one name.
std::string how_to_choose(const std::string& name, const std::string& library) {
  return fmt::format("remove the others, or choose one in the scenario: `plugins: {{{}: {}}}`", name, library);
}

}  // namespace

std::vector<std::string> Registry::search_path(const std::vector<std::string>& extra) {
  std::vector<std::string> folders = extra;
  if (const char* path = std::getenv("MURO_PLUGIN_PATH")) {
    std::string rest = path;
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.push_back(rest.substr(0, colon));
      rest.erase(0, colon + 1);
    }
  }
  if (const char* home = std::getenv("HOME")) folders.push_back(std::string(home) + "/.local/lib/muro");
  const auto program = boost::dll::program_location();
  folders.push_back((program.parent_path().parent_path() / "lib" / "muro").string());
  return folders;
}

Registry::Registry(const std::vector<std::string>& folders) {
  for (const std::string& f : folders) {
    std::error_code code;  // such as that of a missing working directory
    const fs::path from_root = fs::absolute(f, code), resolved = fs::weakly_canonical(from_root, code);
    const std::string absolute = code ? f : resolved.string();
    if (std::any_of(folders_.begin(), folders_.end(), [&](const PluginFolder& k) { return k.path == absolute; }))
      continue;
    folders_.push_back(read_plugin_folder(absolute));
  }
  std::map<std::string, std::vector<const CatalogEntry*>> by_name;
  for (const PluginFolder& folder : folders_) {
    for (const PassedOver& p : folder.passed_over)
      problems_.push_back(fmt::format("{} is passed over: {}", p.file, p.reason));
    for (const CatalogEntry& entry : folder.entries) {
      std::vector<const CatalogEntry*>& known = by_name[entry.id];
      if (std::none_of(known.begin(), known.end(),
                       [&](const CatalogEntry* k) { return is_same_library(k->library, entry.library); }))
        known.push_back(&entry);
    }
  }
  for (const auto& [id, entries] : by_name) {
    offered_.push_back(*entries.front());
    if (entries.size() == 1) continue;
    std::vector<std::string> libraries;
    for (const CatalogEntry* entry : entries) libraries.push_back(entry->library);
    rivals_[id] = fmt::format("`{}` is offered by several plugins: {}; {}", id, fmt::join(libraries, " and "),
                              how_to_choose(id, libraries.front()));
  }
  catalog_ = offered_;
}

void Registry::choose(const std::map<std::string, PluginChoice>& choices) {
  chosen_.clear();
  catalog_ = offered_;
  std::vector<std::string> problems;
  for (const auto& [name, choice] : choices) {
    const std::string path = fs::absolute(choice.library).lexically_normal().string();
    try {
      const CatalogEntry& entry = chosen_.emplace(name, entry_of(path, name)).first->second;
      std::erase_if(catalog_, [&](const CatalogEntry& k) { return k.id == entry.id; });
      catalog_.push_back(entry);
    } catch (const SetupError& e) {
      problems.push_back(
          fmt::format("{}{} cannot be chosen for `{}`: {}", prefix_of(choice.place), path, name, e.what()));
    }
  }
  std::sort(catalog_.begin(), catalog_.end(), [](const CatalogEntry& a, const CatalogEntry& b) { return a.id < b.id; });
  if (!problems.empty()) throw SetupError(problems);
}

/// Returns the folders in which plugins were searched, and what was passed over there.
std::string Registry::searched() const {
  constexpr std::size_t most = 5;
  std::string text = "searched: ";
  std::vector<std::string> passed_over;
  for (const PluginFolder& f : folders_) {
    text += fmt::format("{}{} ({})", &f == &folders_.front() ? "" : ", ", f.path, f.outcome());
    for (const PassedOver& p : f.passed_over) passed_over.push_back(fmt::format("{}: {}", p.file, p.reason));
  }
  if (folders_.empty()) text += "no folder";
  for (std::size_t i = 0; i < std::min(most, passed_over.size()); ++i) text += "; passed over: " + passed_over[i];
  if (passed_over.size() > most) text += fmt::format("; and {} more", passed_over.size() - most);
  return text;
}

const CatalogEntry& Registry::find(const std::string& id) const {
  if (const auto chosen = chosen_.find(id); chosen != chosen_.end()) return chosen->second;
  if (const auto rivals = rivals_.find(id); rivals != rivals_.end()) throw SetupError(rivals->second);
  const auto it =
      std::find_if(catalog_.begin(), catalog_.end(), [&](const CatalogEntry& entry) { return entry.id == id; });
  if (it != catalog_.end()) return *it;
  std::vector<std::string> ids, family;
  for (const CatalogEntry& entry : catalog_) {
    ids.push_back(entry.id);
    if (entry.id.substr(0, entry.id.find('.')) == id.substr(0, id.find('.'))) family.push_back(entry.id);
  }
  const std::string advice = ids.empty()      ? "no plugin was found; set MURO_PLUGIN_PATH or --plugin-path"
                             : family.empty() ? "`muro plugins list` shows all"
                                              : fmt::format("there are: {}", fmt::join(family, ", "));
  const std::string nearest = did_you_mean(id, ids);
  const bool is_slip = !nearest.empty() && problems_.empty();
  throw SetupError(fmt::format("no plugin offers `{}`{}; {}{}", id, nearest, advice, is_slip ? "" : "; " + searched()));
}

const abi::PluginTable& Registry::load(const CatalogEntry& entry) {
  const auto known = tables_.find(entry.library);
  if (known != tables_.end()) return *known->second;
  const abi::PluginTable& table = load_plugin(entry.library);
  std::ifstream text(entry.description);
  if (nlohmann::json::parse(text).value("token", "") != abi::token(table))
    throw SetupError(fmt::format("plugin {} is not the one that {} describes; build it again, so that both are new",
                                 entry.library, entry.description));
  tables_[entry.library] = &table;
  return table;
}

const abi::AlgorithmEntry& Registry::algorithm(const std::string& id) {
  const CatalogEntry& entry = find(id);
  for (const abi::AlgorithmEntry& e : load(entry).algorithms)
    if (e.description->id == id) return e;
  throw SetupError(fmt::format("`{}` is a {}, no algorithm", id, entry.kind));
}

const abi::ReaderEntry& Registry::reader_of(const CatalogEntry& entry) {
  for (const abi::ReaderEntry& e : load(entry).readers)
    if (e.description->id == entry.id) return e;
  throw SetupError(fmt::format("`{}` is an algorithm of kind {}, no model reader", entry.id, entry.kind));
}

const abi::ReaderEntry& Registry::reader(const std::string& id) { return reader_of(find(id)); }

const abi::ReaderEntry& Registry::reader_for(const std::string& path) {
  const std::string extension = extension_of(path);
  if (const auto chosen = chosen_.find(extension); chosen != chosen_.end()) return reader_of(chosen->second);
  std::vector<std::string> known;
  std::vector<const CatalogEntry*> fitting;
  for (const CatalogEntry& entry : catalog_) {
    known.insert(known.end(), entry.extensions.begin(), entry.extensions.end());
    if (reads(entry, extension)) fitting.push_back(&entry);
  }
  if (fitting.size() == 1) return reader(fitting.front()->id);
  if (fitting.empty())
    throw SetupError(fmt::format("no reader for models of type `{}` ({}); known types: {}{}", extension, path,
                                 known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")),
                                 known.empty() || !problems_.empty() ? "; " + searched() : ""));
  std::vector<std::string> offers;
  for (const CatalogEntry* entry : fitting) offers.push_back(fmt::format("`{}` of {}", entry->id, entry->library));
  throw SetupError(fmt::format("models of type `{}` ({}) are read by {}; {}", extension, path,
                               fmt::join(offers, " and "), how_to_choose(extension, fitting.front()->library)));
}

std::string Registry::writers_of(std::string_view key) const {
  std::vector<std::string> ids;
  for (const CatalogEntry& entry : catalog_)
    if (std::find(entry.writes.begin(), entry.writes.end(), key) != entry.writes.end()) ids.push_back(entry.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

std::vector<UsedLibrary> Registry::loaded() const {
  std::vector<UsedLibrary> all;
  for (const auto& [path, table] : tables_)
    all.push_back({path, std::string(table->name), std::string(table->version)});
  return all;
}

}  // namespace muro
