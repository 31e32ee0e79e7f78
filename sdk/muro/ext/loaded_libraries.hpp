// SPDX-License-Identifier: MIT
// Where an algorithm that loads libraries of its own tells of them.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A library that an algorithm has loaded, as it stands in reports.
struct LoadedLibrary {
  std::string_view path;  ///< absolute
  std::string_view name;  ///< as the library calls itself
  std::string_view version;
};

/// An extension of hosts, version 1: reports name the libraries that are told here beside those of plugins.
class LoadedLibraries {
 public:
  /// Told twice, it stands in reports once. The texts are copied. [setup]
  virtual void add(const LoadedLibrary& library) noexcept = 0;

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
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
