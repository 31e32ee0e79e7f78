// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// Options of a command that name a file to write, with what they name: {"--report", "report.json"}, or nothing.
using OutputOptions = std::vector<std::pair<std::string, std::string>>;

/// Adds these files to what the simulation writes, to be checked when it is built.
void add_outputs(Simulation& simulation, const OutputOptions& options);

}  // namespace muro::host
