// SPDX-License-Identifier: MIT
#include "core/plugin_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "muro/description.hpp"
#include "muro/detail/names.hpp"

namespace muro {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr std::string_view library_suffix = ".so", description_suffix = ".muro.json";

/// Returns `path` with the end `from` replaced by `to`.
std::string with_suffix(std::string path, std::string_view from, std::string_view to) {
  path.resize(path.size() - from.size());
  return path.append(to);
}

std::string description_of(const std::string& library) {
  return with_suffix(library, library_suffix, description_suffix);
}

/// Returns the names of the properties in a list of uses; none when there is no list.
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

CatalogEntry entry_from(const Json& json, const Json& plugin, const std::string& library) {
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
  entry.library = library;
  entry.description = description_of(library);
  return entry;
}

/// Returns why the description beside a library cannot be read, without opening it; empty: it can.
std::string problem_with(const std::string& library) {
  const fs::path description = description_of(library);
  const std::string name = description.filename().string();
  std::error_code error;
  const fs::file_status status = fs::status(description, error);
  if (!fs::exists(status))
    return fmt::format("it has no description {} beside it; muro_add_plugin() or the program muro_describe writes one",
                       name);
  if (!fs::is_regular_file(status)) return fmt::format("its description {} is no file", name);
  if (!fs::exists(library, error)) return fmt::format("it describes {}, which is not beside it", library);
  return "";
}

}  // namespace

std::vector<CatalogEntry> read_description_of(const std::string& library) {
  if (const std::string problem = problem_with(library); !problem.empty()) throw SetupError(problem);
  const std::string description = description_of(library);
  std::vector<CatalogEntry> entries;
  try {
    std::ifstream text(description);
    if (!text) throw std::runtime_error("it may not be read");
    const Json plugin = Json::parse(text);
    for (const char* list : {"algorithms", "readers"})
      for (const Json& json : plugin.at(list)) entries.push_back(entry_from(json, plugin, library));
  } catch (const std::exception& e) {
    throw SetupError(fmt::format("its description {} cannot be read: {}; build the plugin again",
                                 fs::path(description).filename().string(), e.what()));
  }
  return entries;
}

std::string PluginFolder::outcome() const {
  return problem.empty() ? fmt::format("{} plugin{}", plugins, plugins == 1 ? "" : "s") : problem;
}

PluginFolder read_plugin_folder(const std::string& path) {
  PluginFolder folder;
  folder.path = path;
  std::error_code error;
  fs::directory_iterator files(path, error);
  if (error) {
    folder.problem = error == std::errc::no_such_file_or_directory ? "it does not exist" : error.message();
    return folder;
  }
  std::vector<std::string> libraries;
  for (; !error && files != fs::directory_iterator(); files.increment(error)) {
    const std::string file = files->path().string();
    if (file.ends_with(library_suffix)) libraries.push_back(file);
    if (file.ends_with(description_suffix)) libraries.push_back(with_suffix(file, description_suffix, library_suffix));
  }
  std::sort(libraries.begin(), libraries.end());
  libraries.erase(std::unique(libraries.begin(), libraries.end()), libraries.end());
  for (const std::string& library : libraries) {
    try {
      std::vector<CatalogEntry> entries = read_description_of(library);
      std::move(entries.begin(), entries.end(), std::back_inserter(folder.entries));
      ++folder.plugins;
    } catch (const SetupError& e) {
      const bool is_there = fs::exists(library, error);
      folder.passed_over.push_back({is_there ? library : description_of(library), e.what()});
    }
  }
  return folder;
}

}  // namespace muro
