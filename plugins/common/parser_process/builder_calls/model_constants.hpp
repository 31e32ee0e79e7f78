// SPDX-License-Identifier: MIT
// What a reader of models says of a robot beside its tree: constants that motions look for.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::model_constants {

// Of a robot that was read from an MJCF file. Numbers are MuJoCo's ids in the compiled model.
/// On the base: path of the file.
inline constexpr Key<TextId> mjcf_file{"mjcf.file", "1", "path of the MJCF file of the robot"};
/// On the base: 1 where the robot is part of a world file, whose scenery is that of the scene.
inline constexpr Key<std::uint32_t> mjcf_in_world{"mjcf.in_world", "1", "whether the file was read as a world"};
/// On each body that is one of the file's.
inline constexpr Key<std::uint32_t> mjcf_body{"mjcf.body", "1", "number of the body in MuJoCo"};
/// On each joint.
inline constexpr Key<std::uint32_t> mjcf_joint{"mjcf.joint", "1", "number of the joint in MuJoCo"};

}  // namespace muro::model_constants
