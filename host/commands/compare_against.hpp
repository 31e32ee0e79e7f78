// SPDX-License-Identifier: MIT
#pragma once

#include "host/commands/commands.hpp"
#include "host/tools/compare/comparison.hpp"

namespace muro::host {

/// Compares every variation with every record of --against: records of a joint by running its commands, records of a
/// laser scanner by noise, mixed pixels and drop-outs. Returns the exit code.
int compare_against(const CompareOptions& options, const Comparison& comparison,
                    const std::vector<Variation>& variations, Registry& registry);

}  // namespace muro::host
