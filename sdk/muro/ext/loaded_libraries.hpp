// SPDX-License-Identifier: MIT
// Libraries that algorithms load themselves, for the report.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A library that an algorithm has loaded.
struct LoadedLibrary {
  std::string_view path;  ///< absolute
  std::string_view name;  ///< as the library calls itself
  std::string_view version;
};

/// An extension of hosts, version 1. Reports name these libraries beside those of plugins.
class LoadedLibraries {
 public:
  /// Adds a library; reports name each once. Copies the texts. [setup]
  virtual void add(const LoadedLibrary& library) noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static LoadedLibraries* of(Host& host) { return static_cast<LoadedLibraries*>(host.find_extension(id())); }

 protected:
  ~LoadedLibraries() = default;
};

inline ExtensionId LoadedLibraries::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(LoadedLibrary), MURO_PLACE(LoadedLibrary, path),
                                           MURO_PLACE(LoadedLibrary, name), MURO_PLACE(LoadedLibrary, version)};
  return {"muro.LoadedLibraries", 1, abi::extension_layout<LoadedLibraries>(structs, &LoadedLibraries::add)};
}

}  // namespace muro
