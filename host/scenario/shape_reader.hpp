// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "host/scenario/map_reader.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// The path of a file that a scenario names relative to the file in which the name is written.
std::string resolve_path(const Location& at, const std::string& name);

/// `shape: plane`, or {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, {capsule: [...]},
/// {mesh: file}, with `friction`, `restitution` and `color` beside it. `mesh` gets the path of the file.
std::optional<Shape> read_shape(MapReader& map, std::string& mesh, Problems& problems);

}  // namespace muro::host
