// SPDX-License-Identifier: MIT
#include "host/outputs/output_options.hpp"

#include "core/output_registry.hpp"

namespace muro::host {

void add_outputs(Simulation& simulation, const OutputOptions& options) {
  for (const auto& [option, file] : options) {
    if (file.empty()) continue;
    simulation.outputs().set_owner(option);
    simulation.outputs().file(file);
  }
}

}  // namespace muro::host
