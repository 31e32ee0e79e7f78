// SPDX-License-Identifier: MIT
// What a reader of models calls the materials of a robot, so that its user can replace them by name.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

/// On a body: the name of the material of each of its `visual.shapes`, in their order; no_text where it has none. For
/// RobotBuilder::set_array, beside the shapes. A robot has no such property: what replaces its materials is in
/// `visual.shapes`.
inline constexpr Key<TextId> visual_materials{"visual.materials", "1",
                                              "array: names of the materials of visual.shapes"};

}  // namespace muro::keys
