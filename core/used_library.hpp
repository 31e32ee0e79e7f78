// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// A library whose code runs in a simulation.
struct UsedLibrary {
  std::string path;  ///< absolute
  std::string name;  ///< as it calls itself
  std::string version;

  bool operator==(const UsedLibrary&) const = default;
};

}  // namespace muro
