// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "muro/features.hpp"

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

/// What the plugin of a library offers, from the description beside it. Throws SetupError, which says what is wrong
/// with the description, without the path of the library.
std::vector<CatalogEntry> read_description_of(const std::string& library);

/// A file that looks like a plugin, or a part of one, and cannot be used.
struct PassedOver {
  std::string file;    ///< absolute path
  std::string reason;  ///< "it has no description NAME.muro.json beside it; ..."
};

/// A folder that was searched for plugins.
struct PluginFolder {
  std::string path;     ///< absolute
  std::string problem;  ///< "it does not exist"; empty: it was read
  std::size_t plugins = 0;
  std::vector<CatalogEntry> entries;
  std::vector<PassedOver> passed_over;

  std::string outcome() const;  ///< "3 plugins", or the problem
};

/// Reads the descriptions of all plugins of a folder: NAME.so with NAME.muro.json beside it.
PluginFolder read_plugin_folder(const std::string& path);

}  // namespace muro
