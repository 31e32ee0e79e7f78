// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "muro/abi.hpp"

namespace muro {

/// An algorithm or reader of a plugin, from its description file: no code of the plugin has run.
struct CatalogEntry {
  std::string id;    ///< "motion.point"
  std::string kind;  ///< "motion", "reader"
  std::string version;
  std::string summary;
  std::vector<std::string> reads, writes;  ///< property names
  std::vector<std::string> extensions;     ///< readers
  std::optional<Features> features;        ///< of a motion; none: its plugin does not say
  std::string plugin;                      ///< name of the plugin
  std::string library;                     ///< absolute path of the .so
  std::string description;                 ///< absolute path of the .muro.json
};

/// Knows the plugins on a search path and loads those that are asked for.
class Registry {
 public:
  /// Where plugins are looked for, in this order: `extra`, MURO_PLUGIN_PATH, the user's folder
  /// (~/.local/lib/muro), the installation (../lib/muro beside the program).
  static std::vector<std::string> search_path(const std::vector<std::string>& extra = {});

  /// Reads the description files in all folders. A name that two folders offer: the first counts; two
  /// plugins of one folder with the same name: an error when the name is used.
  explicit Registry(const std::vector<std::string>& folders);

  const std::vector<CatalogEntry>& catalog() const { return catalog_; }
  const std::vector<std::string>& folders() const { return folders_; }
  /// What could not be read while scanning, a line each.
  const std::vector<std::string>& problems() const { return problems_; }

  /// Throws SetupError with the nearest name, the allowed ones of that family, or the rival plugins.
  const CatalogEntry& find(const std::string& id) const;
  /// Loads the plugin if needed. Throws SetupError when it is refused, or `id` is a reader.
  const abi::AlgorithmEntry& algorithm(const std::string& id);
  const abi::ReaderEntry& reader(const std::string& id);
  /// The reader for a file name's extension. Throws SetupError that names the known ones.
  const abi::ReaderEntry& reader_for(const std::string& path);
  /// "a, b" of the algorithms that say they write the property.
  std::string writers_of(std::string_view key) const;

 private:
  void scan(const std::string& folder);
  const abi::PluginTable& load(const CatalogEntry& entry);

  std::vector<std::string> folders_;
  std::vector<CatalogEntry> catalog_;
  std::map<std::string, std::string> rivals_;  ///< id -> message
  std::map<std::string, const abi::PluginTable*> tables_;
  std::vector<std::string> problems_;
};

}  // namespace muro
