// SPDX-License-Identifier: MIT
#pragma once

#include "muro/model_reader.hpp"
#include "plugins/common/parser_process/message.hpp"

namespace muro::mjcf {

/// Builds the robot that `bytes`, the contents of an MJCF file at `path` (absolute), describe: the first tree of bodies
/// that can move. What is wrong is reported to the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::string& path, RobotBuilder& builder);
/// The same for a world.
void read_world_text(std::string bytes, const std::string& path, WorldBuilder& builder);

/// As read_text, for a file. Throws muro::Error when the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder);
void read_world_file(const std::string& path, WorldBuilder& builder);

/// Compiles a file with `more` elements at its end, and writes the model for a motion: its bytes; for each joint mode
/// and number of its actuator; for each geom the name of the scenery that it is in a world, or nothing. Throws
/// muro::Error with the reason of MuJoCo.
void write_compiled(const std::string& path, const std::string& more, parser_process::Writer& out);

}  // namespace muro::mjcf
