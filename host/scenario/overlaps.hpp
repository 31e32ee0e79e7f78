// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/shape_files.hpp"

namespace muro::host {

/// Two bodies that overlap at their start.
struct Overlap {
  std::string first, second;  ///< names of bodies
  double depth;               ///< m, depth of the deepest contact
};

struct Overlaps {
  std::vector<Overlap> deepest;  ///< the deepest comes first
  std::size_t count = 0;         ///< number of all overlaps
};

/// Finds the bodies that overlap by more than a millimetre before the first step of a built simulation. Pairs that no
/// contact moves or stops are left out, and so are overlaps that the installed plugins cannot find.
Overlaps overlaps_at_start(Simulation& simulation, ShapeFiles& files, std::size_t most);

/// Returns the deepest overlap that the robot would have with the present bodies if it were placed there, when it is
/// more than 5 mm: "`wall` by 0.2 m". Empty: none was found.
std::string overlap_of(Simulation& simulation, ShapeFiles& files, const muro::Placement& placement);

/// Returns a line for each of the deepest overlaps, and one with the number of the others. `place_of`: returns the
/// location in a file that places the robot of a body ("a.yaml:3:5"); empty: there is none.
std::vector<std::string> overlap_notes(Simulation& simulation, ShapeFiles& files,
                                       const std::function<std::string(const std::string& body)>& place_of);

}  // namespace muro::host
