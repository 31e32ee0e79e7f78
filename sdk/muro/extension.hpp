// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace muro {

/// Name of an extension: an interface beside the contract, which one side offers and the other side asks for. Hosts
/// offer extensions to algorithms (Host::find_extension) and to readers (find_extension of builders), algorithms
/// offer them to hosts (Algorithm::find_extension). Each version of an extension is an interface of its own.
struct ExtensionId {
  std::string_view name;  ///< "muro.Inspection"
  std::uint32_t version = 0;
  std::uint32_t layout = 0;  ///< stamp of its structs and functions: see detail/layout.hpp

  bool operator==(const ExtensionId&) const = default;
};

}  // namespace muro
