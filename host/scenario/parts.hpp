// SPDX-License-Identifier: MIT
// Parts of a scenario that robots and scenery share.
#pragma once

#include <optional>
#include <string>

#include "host/scenario/scenario.hpp"
#include "host/scenario/section.hpp"

namespace muro::host {

/// A file name relative to the file that names it.
std::string file_beside(const Location& at, const std::string& name);

/// `{count: [nx, ny], spacing: [dx, dy], center: {...}}`.
Placement read_grid(const Node& n, const std::string& what, Problems& problems);

/// `at: {x, y, ...}`, or `place:` with one of `list`, `grid`, `random`; the origin when there is neither.
Placement read_placement(Section& s, Problems& problems);

/// `shape: plane`, or {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, {capsule: [...]},
/// {mesh: file}, with `friction`, `restitution` and `color` beside it. `mesh` gets the path of the file.
std::optional<Shape> read_shape(Section& s, std::string& mesh, Problems& problems);

/// Each `off` in `map` must switch something off: what an include, a variant or an override replaces by it, or
/// one of `names`.
void check_off(const Node& map, const std::vector<std::string>& names, const std::string& what, Problems& problems);

}  // namespace muro::host
