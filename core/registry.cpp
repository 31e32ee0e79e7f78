// SPDX-License-Identifier: MIT
#include "core/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/plugin_library.hpp"
#include "describe/describe.hpp"
#include "muro/detail/names.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

Json read_description(const fs::path& file) {
  std::ifstream text(file);
  return Json::parse(text);
}

/// The names of the properties that a list of uses contains; none where there is no list.
std::vector<std::string> keys_in(const Json& entry, const char* list) {
  std::vector<std::string> keys;
  for (const Json& use : entry.value(list, Json::array())) keys.push_back(use.at("key"));
  return keys;
}

/// Names of features that this muro does not know are left out.
std::optional<Features> features_in(const Json& entry) {
  if (!entry.contains("features")) return std::nullopt;
  Features bits = 0;
  for (const std::string name : entry["features"])
    for (const FeatureInfo& f : feature_infos)
      if (f.name == name) bits |= f.bit;
  return bits;
}

CatalogEntry catalog_entry_from(const Json& json, const Json& plugin, const fs::path& description) {
  CatalogEntry entry;
  entry.id = json.at("id");
  entry.kind = json.at("kind");
  entry.version = json.at("version");
  entry.summary = json.at("summary");
  entry.reads = keys_in(json, "reads");
  entry.writes = keys_in(json, "writes");
  entry.extensions = json.value("extensions", std::vector<std::string>{});
  if (entry.kind == name_of(Kind::motion)) entry.features = features_in(json);
  entry.plugin = plugin.at("name");
  entry.description = description.string();
  std::string stem = description.filename().string();
  stem.resize(stem.size() - std::string(".muro.json").size());
  entry.library = (description.parent_path() / (stem + ".so")).string();
  return entry;
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
      const Json plugin = read_description(file);
      for (const char* list : {"algorithms", "readers"})
        for (const Json& json : plugin.at(list)) {
          CatalogEntry entry = catalog_entry_from(json, plugin, file);
          const auto known =
              std::find_if(catalog_.begin(), catalog_.end(), [&](const CatalogEntry& k) { return k.id == entry.id; });
          if (known == catalog_.end())
            catalog_.push_back(std::move(entry));
          else if (std::size_t(known - catalog_.begin()) >= before)
            rivals_[entry.id] = fmt::format("`{}` is offered by two plugins: {} and {}; remove one of them", entry.id,
                                            known->library, entry.library);
        }
    } catch (const std::exception& e) {
      problems_.push_back(fmt::format("plugin description {} cannot be read: {}", file.string(), e.what()));
    }
  }
}

const CatalogEntry& Registry::find(const std::string& id) const {
  if (const auto rival = rivals_.find(id); rival != rivals_.end()) throw SetupError(rival->second);
  const auto it =
      std::find_if(catalog_.begin(), catalog_.end(), [&](const CatalogEntry& entry) { return entry.id == id; });
  if (it != catalog_.end()) return *it;
  std::vector<std::string> ids, family;
  for (const CatalogEntry& entry : catalog_) {
    ids.push_back(entry.id);
    if (entry.id.substr(0, entry.id.find('.')) == id.substr(0, id.find('.'))) family.push_back(entry.id);
  }
  const std::string advice =
      ids.empty()
          ? fmt::format("no plugin was found in {}; set MURO_PLUGIN_PATH or --plugin-path", fmt::join(folders_, " "))
      : family.empty() ? "`muro plugins list` shows all"
                       : fmt::format("there are: {}", fmt::join(family, ", "));
  throw SetupError(fmt::format("no plugin offers `{}`{}; {}", id, did_you_mean(id, ids), advice));
}

const abi::PluginTable& Registry::load(const CatalogEntry& entry) {
  const auto known = tables_.find(entry.library);
  if (known != tables_.end()) return *known->second;
  const abi::PluginTable& table = load_plugin(entry.library);
  if (read_description(entry.description).value("token", "") != abi::token(table))
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

const abi::ReaderEntry& Registry::reader(const std::string& id) {
  const CatalogEntry& entry = find(id);
  for (const abi::ReaderEntry& e : load(entry).readers)
    if (e.description->id == id) return e;
  throw SetupError(fmt::format("`{}` is an algorithm of kind {}, no model reader", id, entry.kind));
}

const abi::ReaderEntry& Registry::reader_for(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  std::vector<std::string> known;
  for (const CatalogEntry& entry : catalog_)
    for (const std::string& e : entry.extensions) {
      if (e == extension) return reader(entry.id);
      known.push_back(e);
    }
  if (known.empty()) known.push_back("none, no reader plugin was found");
  throw SetupError(
      fmt::format("no reader for models of type `{}` ({}); known types: {}", extension, path, fmt::join(known, ", ")));
}

std::string Registry::writers_of(std::string_view key) const {
  std::vector<std::string> ids;
  for (const CatalogEntry& entry : catalog_)
    if (std::find(entry.writes.begin(), entry.writes.end(), key) != entry.writes.end()) ids.push_back(entry.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

}  // namespace muro
