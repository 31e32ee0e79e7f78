// SPDX-License-Identifier: MIT
// Which files a run writes: hosts know it before it begins.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// An extension of hosts, version 1. An algorithm that writes files names them in `connect` or `connect_by_name`. A
/// host refuses the run when two outputs would be one file, or an output would overwrite what the scenario is read
/// from.
class Outputs {
 public:
  /// The file at `path`; a relative path starts in the working directory. [setup]
  virtual void file(std::string_view path) noexcept = 0;
  /// Files whose names are `begin`, a number such as a time in digits with a point, and `end`. [setup]
  virtual void series(std::string_view begin, std::string_view end) noexcept = 0;

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
  static Outputs* of(Host& host) { return static_cast<Outputs*>(host.find_extension(id())); }

 protected:
  ~Outputs() = default;
};

inline ExtensionId Outputs::id() noexcept {
  return {"muro.Outputs", 1, abi::extension_layout<Outputs>({}, &Outputs::file, &Outputs::series)};
}

}  // namespace muro
