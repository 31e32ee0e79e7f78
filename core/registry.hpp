// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/plugin_folder.hpp"
#include "core/used_library.hpp"
#include "muro/detail/abi.hpp"

namespace muro {

/// A library that is to offer a name, whatever others do.
struct PluginChoice {
  std::string library;  ///< path
  std::string place;    ///< "file:line:column" of the scenario, put before messages; may be empty
};

/// Knows the plugins on a search path and loads those that are asked for.
class Registry {
 public:
  /// Where plugins are looked for, in this order: `extra`, MURO_PLUGIN_PATH, the user's folder
  /// (~/.local/lib/muro), the installation (../lib/muro beside the program).
  static std::vector<std::string> search_path(const std::vector<std::string>& extra = {});

  /// Reads the description files in all folders.
  explicit Registry(const std::vector<std::string>& folders);

  /// What the folders offer and what was chosen, by name; of plugins that offer the same name, the first.
  const std::vector<CatalogEntry>& catalog() const { return catalog_; }
  const std::vector<PluginFolder>& folders() const { return folders_; }
  /// What was passed over and why, a line each.
  const std::vector<std::string>& problems() const { return problems_; }
  /// The names that several plugins offer, with the message of who asks for one.
  const std::map<std::string, std::string>& rivals() const { return rivals_; }

  /// By an id ("motion.point") or, for readers, by a type of files (".urdf"): from which library it is taken. Replaces
  /// the choices before. Throws SetupError when a library does not offer the name. [set-up]
  void choose(const std::map<std::string, PluginChoice>& choices);

  /// Throws SetupError with the nearest name and what was searched, or with the plugins that all offer it.
  const CatalogEntry& find(const std::string& id) const;
  /// Loads the plugin if needed. Throws SetupError when it is refused, or `id` is a reader.
  const abi::AlgorithmEntry& algorithm(const std::string& id);
  const abi::ReaderEntry& reader(const std::string& id);
  /// The reader for a file name's extension. Throws SetupError that names the known ones, or all that read such files.
  const abi::ReaderEntry& reader_for(const std::string& path);
  /// "a, b" of the algorithms that say they write the property.
  std::string writers_of(std::string_view key) const;
  /// The plugins that were loaded so far.
  std::vector<UsedLibrary> loaded() const;

 private:
  std::string searched() const;
  const abi::PluginTable& load(const CatalogEntry& entry);
  const abi::ReaderEntry& reader_of(const CatalogEntry& entry);

  std::vector<PluginFolder> folders_;
  std::vector<CatalogEntry> offered_, catalog_;  ///< by the folders; with what was chosen
  std::map<std::string, std::string> rivals_;
  std::map<std::string, CatalogEntry> chosen_;             ///< by name or type of files
  std::map<std::string, const abi::PluginTable*> tables_;  ///< by path
  std::vector<std::string> problems_;
};

}  // namespace muro
