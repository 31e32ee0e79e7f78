// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/simulation.hpp"

namespace muro::host {

/// The libraries whose code runs in a simulation, plugins and what they load, for the report: name, version, path and
/// the SHA-256 of the file, as `sha256sum` prints it.
nlohmann::ordered_json libraries_report(const Simulation& simulation);

}  // namespace muro::host
