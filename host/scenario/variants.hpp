// SPDX-License-Identifier: MIT
// Robots of a template whose subsystems or materials differ:
//
//     variants: {"0-4": {motion: {use: motion.point}}, "7": {laser: off, materials: {team: {color: [1, 0, 0]}}}}
#pragma once

#include <string>
#include <vector>

#include "host/scenario/map_reader.hpp"

namespace muro::host {

/// Keys of a robot template that are not subsystems.
extern const std::vector<std::string> template_keys;

/// Changes of robots `first` to `last` of a template.
struct Variant {
  int first, last;
  const Node* changes;
};

/// Reads `variants` of a template of `count` robots; `robot` has read its other keys. `subsystem_names`: names of the
/// subsystems of all robots, which may be switched off. `unknown`: called for changes of other names.
std::vector<Variant> read_variants(const Node& variants, const MapReader& robot, int count,
                                   const std::vector<std::string>& subsystem_names, const TakeUnknown& unknown,
                                   Problems& problems);

/// Returns the subsystems of a template with the changes of some of its variants. `indices`: indices of these variants.
Node merged(const Node& subsystems, const std::vector<Variant>& variants, const std::vector<std::size_t>& indices);

}  // namespace muro::host
