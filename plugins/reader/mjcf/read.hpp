// SPDX-License-Identifier: MIT
#pragma once

#include "muro/model_reader.hpp"
#include "plugins/common/parser_process/message.hpp"

namespace muro::mjcf {

/// Builds the robot that `bytes` describes, the contents of an MJCF file at `path` (absolute). The robot is the first
/// tree of bodies that can move. Problems are reported to the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::string& path, RobotBuilder& builder);
/// Builds the world that `bytes` describes.
void read_world_text(std::string bytes, const std::string& path, WorldBuilder& builder);

/// Builds the robot of a file, see read_text. Throws muro::Error if the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder);
void read_world_file(const std::string& path, WorldBuilder& builder);

/// Compiles a file with the elements `more` added at its end. Writes the model for a motion: its bytes; for each joint
/// the mode and number of its actuator; for each geom the name of its scenery object in a world, or an empty name.
/// Throws muro::Error with MuJoCo's reason.
void write_compiled(const std::string& path, const std::string& more, parser_process::Writer& out);

}  // namespace muro::mjcf
