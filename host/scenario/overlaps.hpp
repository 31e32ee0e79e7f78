// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/shape_files.hpp"

namespace muro::host {

/// Two bodies that overlap where they start.
struct Overlap {
  std::string first, second;  ///< names of bodies
  double depth;               ///< m, of the deepest contact
};

struct Overlaps {
  std::vector<Overlap> deepest;  ///< first the deepest of all
  std::size_t count = 0;         ///< of all
};

/// The bodies that overlap by more than a millimetre before the first step of a built simulation. Pairs that no contact
/// moves or stops are left out, and so is what the plugins that are there cannot find.
Overlaps overlaps_at_start(Simulation& simulation, ShapeFiles& files, std::size_t most);

/// What the robot would overlap by more than 5 mm, as all bodies are now, if it were placed there, the deepest: "`wall`
/// by 0.2 m"; empty: nothing that could be found.
std::string overlap_of(Simulation& simulation, ShapeFiles& files, const muro::Placement& placement);

/// A line for each of the deepest, and one for how many more there are. `place_of`: where a file says where the robot
/// of a body is ("a.yaml:3:5"); empty: nowhere.
std::vector<std::string> overlap_notes(Simulation& simulation, ShapeFiles& files,
                                       const std::function<std::string(const std::string& body)>& place_of);

}  // namespace muro::host
