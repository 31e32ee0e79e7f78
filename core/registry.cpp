// SPDX-License-Identifier: MIT
#include "core/registry.hpp"

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/property_tree/json_parser.hpp>
#include <cstdlib>
#include <filesystem>

#include "core/error.hpp"
#include "core/plugin_library.hpp"
#include "describe/describe.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro {

namespace fs = std::filesystem;
using boost::property_tree::ptree;

namespace {

std::vector<std::string> names_in(const ptree& tree, const char* list, const char* member) {
  std::vector<std::string> names;
  if (const auto found = tree.get_child_optional(list))
    for (const auto& [unused, entry] : *found) names.push_back(*member ? entry.get<std::string>(member) : entry.data());
  return names;
}

/// Names of features that this muro does not know are left out.
std::optional<Features> features_in(const ptree& entry) {
  if (!entry.get_child_optional("features")) return std::nullopt;
  Features bits = 0;
  for (const std::string& name : names_in(entry, "features", ""))
    for (const FeatureInfo& f : feature_infos)
      if (f.name == name) bits |= f.bit;
  return bits;
}

CatalogEntry catalog_entry_from(const ptree& entry, const ptree& plugin, const fs::path& description) {
  CatalogEntry o;
  o.id = entry.get<std::string>("id");
  o.kind = entry.get<std::string>("kind");
  o.version = entry.get<std::string>("version");
  o.summary = entry.get<std::string>("summary");
  o.reads = names_in(entry, "reads", "key");
  o.writes = names_in(entry, "writes", "key");
  o.extensions = names_in(entry, "extensions", "");
  if (o.kind == name_of(Kind::motion)) o.features = features_in(entry);
  o.plugin = plugin.get<std::string>("name");
  o.description = description.string();
  std::string stem = description.filename().string();
  stem.resize(stem.size() - std::string(".muro.json").size());
  o.library = (description.parent_path() / (stem + ".so")).string();
  return o;
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
    const std::string absolute = fs::weakly_canonical(fs::absolute(f)).string();
    if (std::find(folders_.begin(), folders_.end(), absolute) != folders_.end()) continue;
    folders_.push_back(absolute);
    scan(absolute);
  }
  std::sort(catalog_.begin(), catalog_.end(), [](const CatalogEntry& a, const CatalogEntry& b) { return a.id < b.id; });
}

void Registry::scan(const std::string& folder) {
  std::error_code none;
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(folder, none))
    if (file.path().filename().string().ends_with(".muro.json")) files.push_back(file.path());
  std::sort(files.begin(), files.end());
  const std::size_t before = catalog_.size();
  for (const fs::path& file : files) {
    try {
      ptree plugin;
      boost::property_tree::read_json(file.string(), plugin);
      for (const char* list : {"algorithms", "readers"})
        for (const auto& [unused, entry] : plugin.get_child(list)) {
          CatalogEntry o = catalog_entry_from(entry, plugin, file);
          const auto known =
              std::find_if(catalog_.begin(), catalog_.end(), [&](const CatalogEntry& k) { return k.id == o.id; });
          if (known == catalog_.end())
            catalog_.push_back(std::move(o));
          else if (std::size_t(known - catalog_.begin()) >= before)
            rivals_[o.id] = "`" + o.id + "` is offered by two plugins: " + known->library + " and " + o.library +
                            "; remove one of them";
        }
    } catch (const std::exception& e) {
      problems_.push_back("plugin description " + file.string() + " cannot be read: " + e.what());
    }
  }
}

const CatalogEntry& Registry::find(const std::string& id) const {
  if (const auto rival = rivals_.find(id); rival != rivals_.end()) throw SetupError(rival->second);
  const auto it = std::find_if(catalog_.begin(), catalog_.end(), [&](const CatalogEntry& o) { return o.id == id; });
  if (it != catalog_.end()) return *it;
  std::vector<std::string> ids, family;
  for (const CatalogEntry& o : catalog_) {
    ids.push_back(o.id);
    if (o.id.substr(0, o.id.find('.')) == id.substr(0, id.find('.'))) family.push_back(o.id);
  }
  std::string message = "no plugin offers `" + id + "`" + did_you_mean(id, ids);
  if (ids.empty()) {
    message += "; no plugin was found in";
    for (const std::string& f : folders_) message += " " + f;
    message += "; set MURO_PLUGIN_PATH or --plugin-path";
  } else if (!family.empty()) {
    message += "; there are: ";
    for (const std::string& f : family) message += (&f == family.data() ? "" : ", ") + f;
  } else {
    message += "; `muro plugins list` shows all";
  }
  throw SetupError(message);
}

const abi::PluginTable& Registry::load(const CatalogEntry& offer) {
  const auto known = tables_.find(offer.library);
  if (known != tables_.end()) return *known->second;
  const abi::PluginTable& table = load_plugin(offer.library);
  ptree description;
  boost::property_tree::read_json(offer.description, description);
  if (description.get<std::string>("token", "") != abi::token(table))
    throw SetupError("plugin " + offer.library + " is not the one that " + offer.description +
                     " describes; build it again, so that both are new");
  tables_[offer.library] = &table;
  return table;
}

const abi::AlgorithmEntry& Registry::algorithm(const std::string& id) {
  const CatalogEntry& offer = find(id);
  for (const abi::AlgorithmEntry& e : load(offer).algorithms)
    if (e.description->id == id) return e;
  throw SetupError("`" + id + "` is a " + offer.kind + ", no algorithm");
}

const abi::ReaderEntry& Registry::reader(const std::string& id) {
  const CatalogEntry& offer = find(id);
  for (const abi::ReaderEntry& e : load(offer).readers)
    if (e.description->id == id) return e;
  throw SetupError("`" + id + "` is an algorithm of kind " + offer.kind + ", no model reader");
}

const abi::ReaderEntry& Registry::reader_for(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  std::string known;
  for (const CatalogEntry& o : catalog_)
    for (const std::string& e : o.extensions) {
      if (e == extension) return reader(o.id);
      known += (known.empty() ? "" : ", ") + e;
    }
  throw SetupError("no reader for models of type `" + extension + "` (" + path +
                   "); known types: " + (known.empty() ? "none, no reader plugin was found" : known));
}

std::string Registry::writers_of(std::string_view key) const {
  std::string all;
  for (const CatalogEntry& o : catalog_)
    if (std::find(o.writes.begin(), o.writes.end(), key) != o.writes.end()) all += (all.empty() ? "" : ", ") + o.id;
  return all;
}

}  // namespace muro
