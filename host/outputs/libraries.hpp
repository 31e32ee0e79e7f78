// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/simulation.hpp"

namespace muro::host {

/// Libraries of a simulation for the report, plugins and those that they load: name, version, path and the SHA-256 of
/// the file, as `sha256sum` prints it.
nlohmann::ordered_json libraries_report(const Simulation& simulation);

}  // namespace muro::host
