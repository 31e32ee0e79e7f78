// SPDX-License-Identifier: MIT
#include "host/outputs/libraries.hpp"

#include <sha256.h>

#include <nlohmann/json.hpp>

namespace muro::host {

namespace {

/// Returns the SHA-256; empty when the file cannot be read.
std::string sha256_of(const std::string& path) {
  char digits[SHA256_DIGEST_STRING_LENGTH];
  return SHA256File(path.c_str(), digits) ? digits : "";
}

}  // namespace

nlohmann::ordered_json libraries_report(const Simulation& simulation) {
  auto all = nlohmann::ordered_json::array();
  for (const UsedLibrary& library : simulation.libraries())
    all.push_back({{"name", library.name},
                   {"version", library.version},
                   {"path", library.path},
                   {"sha256", sha256_of(library.path)}});
  return all;
}

}  // namespace muro::host
