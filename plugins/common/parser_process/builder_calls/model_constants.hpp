// SPDX-License-Identifier: MIT
// Constants of a robot beside its tree that a reader of models writes and motions look up.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::model_constants {

// Constants of a robot that was read from an MJCF file. Numbers are MuJoCo's ids in the compiled model.
/// Path of the file, on the base.
inline constexpr Key<TextId> mjcf_file{"mjcf.file", "1", "path of the MJCF file of the robot"};
/// 1 on the base if the robot is part of a world file, whose scenery is that of the scene.
inline constexpr Key<std::uint32_t> mjcf_in_world{"mjcf.in_world", "1", "whether the file was read as a world"};
/// Number of a body, on each body of the file.
inline constexpr Key<std::uint32_t> mjcf_body{"mjcf.body", "1", "number of the body in MuJoCo"};
/// Number of a joint, on each joint.
inline constexpr Key<std::uint32_t> mjcf_joint{"mjcf.joint", "1", "number of the joint in MuJoCo"};

}  // namespace muro::model_constants
