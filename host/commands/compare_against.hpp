// SPDX-License-Identifier: MIT
#pragma once

#include "host/commands/commands.hpp"
#include "host/tools/compare/comparison.hpp"

namespace muro::host {

/// Every variation beside every record of --against: those of a joint on its commands, those of a laser scanner by
/// noise, mixed pixels and drop-outs. Returns the exit code.
int compare_against(const CompareOptions& options, const Comparison& comparison,
                    const std::vector<Variation>& variations, Registry& registry);

}  // namespace muro::host
