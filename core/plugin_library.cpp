// SPDX-License-Identifier: MIT
#include "core/plugin_library.hpp"

#include <fmt/format.h>

#include <boost/dll/shared_library.hpp>
#include <deque>
#include <mutex>

#include "core/error.hpp"
#include "core/own_table.hpp"
#include "core/running_call.hpp"
#include "muro/base/whole_library.hpp"
#include "muro/detail/contract_layout.hpp"
#include "muro/detail/stamp.hpp"

namespace muro {

std::string difference(const abi::Stamp& ours, const abi::Stamp& theirs) {
  if (std::memcmp(ours.magic, theirs.magic, sizeof ours.magic) != 0)
    return "its table does not begin with \"MUROPLUG\"";
  std::string found;
  const auto field = [&](const char* name, std::uint32_t a, std::uint32_t b) {
    if (found.empty() && a != b) found = fmt::format("{} is {} in the plugin and {} in this muro", name, b, a);
  };
  field("stamp_size", ours.stamp_size, theirs.stamp_size);
  field("sdk_major", ours.sdk_major, theirs.sdk_major);
  if (found.empty() && theirs.sdk_minor > ours.sdk_minor)
    found = fmt::format("sdk_minor is {} in the plugin and only {} in this muro", theirs.sdk_minor, ours.sdk_minor);
  field("pointer_size", ours.pointer_size, theirs.pointer_size);
  if (found.empty() && std::memcmp(ours.standard_library, theirs.standard_library, sizeof ours.standard_library) != 0)
    found = fmt::format("standard_library is {} in the plugin and {} in this muro",
                        std::string_view(theirs.standard_library, strnlen(theirs.standard_library, 16)),
                        ours.standard_library);
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

/// Returns the system's words in the loader's text, without the path, which the message names already.
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

/// Throws SetupError unless this muro can use the table. Reads nothing beyond the part that it has found valid.
void check_table(const abi::PluginTable& table, const std::string& path) {
  constexpr const char* again = "build it again with muro_add_plugin() of this muro";
  static constexpr abi::Stamp ours = abi::make_stamp();
  const std::string differs = difference(ours, table.stamp);
  if (!differs.empty())
    throw SetupError(fmt::format("plugin {} was built for another muro: {}; {}{}", path, differs, again,
                                 ours.sdk_major == table.stamp.sdk_major
                                     ? ""
                                     : "; sdk/CHANGELOG.md says what to write for a new version of the SDK"));
  if (table.table_size != sizeof table)
    throw SetupError(fmt::format("plugin {} has a table of {} bytes instead of {}; {}", path, table.table_size,
                                 sizeof table, again));
  if (table.layout != abi::layout_of_contract())
    throw SetupError(
        fmt::format("plugin {} was built for another muro: layout is {:08x} in the plugin and {:08x} in this muro: "
                    "structs of its SDK were changed; {}",
                    path, table.layout, abi::layout_of_contract(), again));
}

}  // namespace

const abi::PluginTable& load_plugin(const std::string& path) {
  namespace dll = boost::dll;
  static std::mutex mutex;
  // never unloaded, at the end of the program neither: objects of plugins may outlive any caller
  struct Loaded {
    Loaded(const dll::shared_library& library_, const abi::PluginTable& given) : library(library_), own(given) {}
    dll::shared_library library;
    OwnTable own;
  };
  static auto& loaded = *new std::deque<Loaded>;
  const Callee callee{.name = "plugin " + path, .library = path};
  const CallScope scope(callee, "load");  // constructors of the library run
  dll::shared_library library;
  // an absolute path needs no working directory, which may not exist any more
  const boost::dll::fs::path given = path, absolute = given.is_absolute() ? given : boost::dll::fs::absolute(given);
  if (const std::string missing = missing_part_of_library(absolute.string()); !missing.empty())
    throw SetupError(fmt::format("plugin {} cannot be loaded: {}", path, missing));
  try {
    library.load(absolute, dll::load_mode::rtld_now | dll::load_mode::rtld_local);
  } catch (const std::exception& e) {
    throw SetupError(fmt::format("plugin {} cannot be loaded: {}", path, reason_of(e.what(), absolute.string())));
  }
  if (!library.has(abi::table_symbol))
    throw SetupError(fmt::format("plugin {} exports no `{}`: it is no muro plugin; close it with MURO_PLUGIN", path,
                                 abi::table_symbol));
  const auto& table = library.get<const abi::PluginTable>(abi::table_symbol);
  check_table(table, path);
  const std::lock_guard lock(mutex);
  return loaded.emplace_back(library, table).own.table();
}

}  // namespace muro
