// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// Options of a command that name an output file, with the name: {"--report", "report.json"}; the name may be empty.
using OutputOptions = std::vector<std::pair<std::string, std::string>>;

/// Adds these files to the outputs of the simulation, to be checked when it is built.
void add_outputs(Simulation& simulation, const OutputOptions& options);

}  // namespace muro::host
