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
/// {mesh: file}, {heightmap: file, size: [x, y, z]}, with `friction`, `restitution`, `color` and `texture` beside it.
/// `mesh` and `texture` get the paths of the files.
std::optional<Shape> read_shape(MapReader& map, std::string& mesh, std::string& texture, Problems& problems);

}  // namespace muro::host
