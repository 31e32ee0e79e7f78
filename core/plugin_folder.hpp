// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "muro/features.hpp"

namespace muro {

/// An algorithm or reader of a plugin, as its description file says; no code of the plugin has run.
struct CatalogEntry {
  std::string id;    ///< "motion.point"
  std::string kind;  ///< "motion", "reader"
  std::string version;
  std::string summary;
  std::vector<std::string> reads, writes;  ///< property names
  std::vector<std::string> extensions;     ///< file name extensions, for readers
  std::optional<Features> features;        ///< for a motion; empty: its plugin does not say
  std::string plugin;                      ///< name of the plugin
  std::string library;                     ///< absolute path of the .so
  std::string description;                 ///< absolute path of the .muro.json
};

/// Returns the algorithms and readers that a plugin offers, from the description beside its library. Throws SetupError
/// that says what is wrong with the description, without the path of the library.
std::vector<CatalogEntry> read_description_of(const std::string& library);

/// A file that looks like a plugin, or like a part of one, and cannot be used.
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
