// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "host/scenario/map_reader.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// The path of a file that a scenario names relative to the file in which the name is written.
std::string resolve_path(const Location& at, const std::string& name);

/// The path of the file that `key` names; a problem when there is none.
std::string file_of(MapReader& map, const std::string& key, Problems& problems);

/// `color: [r, g, b]` or `[r, g, b, a]`, 0..1, as red, green, blue, alpha. None where there is no such key.
std::optional<Eigen::Vector4d> read_color(MapReader& map);

/// `shape: plane`, or {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, {capsule: [...]},
/// {mesh: file}, {heightmap: file, size: [x, y, z]}, with `friction`, `restitution`, `color` and `texture` beside it.
/// `mesh` and `texture` get the paths of the files.
std::optional<Shape> read_shape(MapReader& map, std::string& mesh, std::string& texture, Problems& problems);

}  // namespace muro::host
