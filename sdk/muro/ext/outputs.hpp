// SPDX-License-Identifier: MIT
// Files that a run writes: hosts know them before it begins.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// An extension of hosts, version 1. An algorithm that writes files names them in `connect` or `connect_by_name`. A
/// host refuses the run when two outputs are one file, or an output overwrites a file that the scenario is read from.
class Outputs {
 public:
  /// Names the file at `path`; a relative path starts in the working directory. [setup]
  virtual void file(std::string_view path) noexcept = 0;
  /// Names files with `begin`, a number such as a time in digits with a point, and `end`. [setup]
  virtual void series(std::string_view begin, std::string_view end) noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static Outputs* of(Host& host) { return static_cast<Outputs*>(host.find_extension(id())); }

 protected:
  ~Outputs() = default;
};

inline ExtensionId Outputs::id() noexcept {
  return {"muro.Outputs", 1, abi::extension_layout<Outputs>({}, &Outputs::file, &Outputs::series)};
}

}  // namespace muro
