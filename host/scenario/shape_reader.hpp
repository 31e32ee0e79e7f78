// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "host/scenario/map_reader.hpp"
#include "muro/shape.hpp"

namespace muro::host {

/// Returns the path of a file that a scenario names, relative to the file that contains the name.
std::string resolve_path(const Location& at, const std::string& name);

/// Returns the path of the file that `key` names; adds a problem when there is none.
std::string file_of(MapReader& map, const std::string& key, Problems& problems);

/// Reads `color: [r, g, b]` or `[r, g, b, a]`, 0..1, as red, green, blue, alpha. Returns nothing without this key.
std::optional<Eigen::Vector4d> read_color(MapReader& map);

/// Reads `shape: plane`, or {box: [x, y, z]}, {sphere: radius}, {cylinder: [radius, length]}, {capsule: [...]}, {mesh:
/// file}, {heightmap: file, size: [x, y, z]}, with additional `friction`, `restitution`, `color` and `texture`. `mesh`
/// and `texture` get the paths of the files.
std::optional<Shape> read_shape(MapReader& map, std::string& mesh, std::string& texture, Problems& problems);

}  // namespace muro::host
