// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/plugin_folder.hpp"
#include "core/used_library.hpp"
#include "muro/detail/abi.hpp"

namespace muro {

/// A library that has to offer a name, even when others offer it too.
struct PluginChoice {
  std::string library;  ///< path
  std::string place;    ///< "file:line:column" of the scenario, put before messages; may be empty
};

/// Holds the plugins on a search path and loads them when they are requested.
class Registry {
 public:
  /// Returns the folders in which plugins are searched, in this order: `extra`, MURO_PLUGIN_PATH, the user's folder
  /// (~/.local/lib/muro), the installation (../lib/muro beside the program).
  static std::vector<std::string> search_path(const std::vector<std::string>& extra = {});

  /// Reads the description files in all folders.
  explicit Registry(const std::vector<std::string>& folders);

  /// Entries of the folders and chosen entries, by name. When several plugins offer a name, the first counts.
  const std::vector<CatalogEntry>& catalog() const { return catalog_; }
  const std::vector<PluginFolder>& folders() const { return folders_; }
  /// Files that were passed over, with the reason, one line each.
  const std::vector<std::string>& problems() const { return problems_; }
  /// Names that several plugins offer, with the message for a request of that name.
  const std::map<std::string, std::string>& rivals() const { return rivals_; }

  /// Chooses the library for an id ("motion.point") or, for readers, for a type of files (".urdf"). Replaces earlier
  /// choices. Throws SetupError when a library does not offer the name. [set-up]
  void choose(const std::map<std::string, PluginChoice>& choices);

  /// Throws SetupError with the nearest name and the searched folders, or with all plugins that offer it.
  const CatalogEntry& find(const std::string& id) const;
  /// Loads the plugin if needed. Throws SetupError when it is refused, or `id` is a reader.
  const abi::AlgorithmEntry& algorithm(const std::string& id);
  const abi::ReaderEntry& reader(const std::string& id);
  /// Returns the reader for a file's extension. Throws SetupError with the known extensions, or all readers of them.
  const abi::ReaderEntry& reader_for(const std::string& path);
  /// Returns the names of the algorithms that declare that they write the property: "a, b".
  std::string writers_of(std::string_view key) const;
  /// The plugins that were loaded so far.
  std::vector<UsedLibrary> loaded() const;

 private:
  std::string searched() const;
  const abi::PluginTable& load(const CatalogEntry& entry);
  const abi::ReaderEntry& reader_of(const CatalogEntry& entry);

  std::vector<PluginFolder> folders_;
  std::vector<CatalogEntry> offered_, catalog_;  ///< from the folders; with the chosen ones
  std::map<std::string, std::string> rivals_;
  std::map<std::string, CatalogEntry> chosen_;             ///< by name or type of files
  std::map<std::string, const abi::PluginTable*> tables_;  ///< by path
  std::vector<std::string> problems_;
};

}  // namespace muro
