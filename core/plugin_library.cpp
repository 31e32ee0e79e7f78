// SPDX-License-Identifier: MIT
#include "core/plugin_library.hpp"

#include <boost/dll/shared_library.hpp>
#include <deque>

#include "core/error.hpp"

namespace muro {

std::string difference(const abi::Stamp& ours, const abi::Stamp& theirs) {
  if (std::memcmp(ours.magic, theirs.magic, sizeof ours.magic) != 0)
    return "its table does not begin with \"MUROPLUG\"";
  std::string found;
  const auto field = [&](const char* name, std::uint32_t a, std::uint32_t b) {
    if (found.empty() && a != b)
      found =
          std::string(name) + " is " + std::to_string(b) + " in the plugin and " + std::to_string(a) + " in this muro";
  };
  field("stamp_size", ours.stamp_size, theirs.stamp_size);
  field("sdk_major", ours.sdk_major, theirs.sdk_major);
  if (found.empty() && theirs.sdk_minor > ours.sdk_minor)
    found = "sdk_minor is " + std::to_string(theirs.sdk_minor) + " in the plugin and only " +
            std::to_string(ours.sdk_minor) + " in this muro";
  field("pointer_size", ours.pointer_size, theirs.pointer_size);
  if (found.empty() && std::memcmp(ours.standard_library, theirs.standard_library, sizeof ours.standard_library) != 0)
    found = "standard_library is " + std::string(theirs.standard_library, strnlen(theirs.standard_library, 16)) +
            " in the plugin and " + ours.standard_library + " in this muro";
  field("standard_library_abi", ours.standard_library_abi, theirs.standard_library_abi);
  field("standard_library_debug", ours.standard_library_debug, theirs.standard_library_debug);
  field("eigen_version", ours.eigen_version, theirs.eigen_version);
  field("eigen_max_align_bytes", ours.eigen_max_align_bytes, theirs.eigen_max_align_bytes);
  field("eigen_malloc_already_aligned", ours.eigen_malloc_already_aligned, theirs.eigen_malloc_already_aligned);
  field("probe_size", ours.probe_size, theirs.probe_size);
  field("probe_align", ours.probe_align, theirs.probe_align);
  field("probe_layout", ours.probe_layout, theirs.probe_layout);
  return found;
}

namespace {

/// The system's words in the loader's text, without the path, which the message names already.
std::string reason_of(std::string text, const std::string& path) {
  const std::string before = "dlerror system message: ";
  if (const std::size_t at = text.find(before); at != std::string::npos) {
    text.erase(0, at + before.size());
    text.resize(std::min(text.size(), text.rfind("): ")));
  }
  for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path)) text.erase(at, path.size());
  const std::size_t first = text.find_first_not_of(": ");
  return first == std::string::npos ? text : text.substr(first);
}

}  // namespace

const abi::PluginTable& load_plugin(const std::string& path) {
  namespace dll = boost::dll;
  static std::deque<dll::shared_library> loaded;  // never unloaded: objects of plugins may outlive any caller
  dll::shared_library library;
  const auto absolute = boost::dll::fs::absolute(path);
  try {
    library.load(absolute, dll::load_mode::rtld_now | dll::load_mode::rtld_local);
  } catch (const std::exception& e) {
    throw SetupError("plugin " + path + " cannot be loaded: " + reason_of(e.what(), absolute.string()));
  }
  if (!library.has(abi::table_symbol))
    throw SetupError("plugin " + path + " exports no `" + abi::table_symbol +
                     "`: it is no muro plugin; close it with MURO_PLUGIN");
  const auto& table = library.get<const abi::PluginTable>(abi::table_symbol);
  static constexpr abi::Stamp ours = abi::make_stamp();
  const std::string differs = difference(ours, table.stamp);
  if (!differs.empty())
    throw SetupError("plugin " + path + " was built for another muro: " + differs +
                     "; build it again with muro_add_plugin() of this muro");
  if (table.table_size != sizeof(abi::PluginTable))
    throw SetupError("plugin " + path + " has a table of " + std::to_string(table.table_size) + " bytes instead of " +
                     std::to_string(sizeof(abi::PluginTable)) + "; build it again with muro_add_plugin() of this muro");
  loaded.push_back(library);
  return table;
}

}  // namespace muro
