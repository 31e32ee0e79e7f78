// SPDX-License-Identifier: MIT
// Properties for data of a model that are no part of the robot. A reader of models hands them to the host by
// RobotBuilder::set and set_array.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

// Constants of the body of a model that is a single file. The host asks for them to place objects that stand on the
// body.
/// Array: values of the heightmap, row by row from -y, in each row from -x (see toolkit/heightmap.hpp).
inline constexpr Key<float> heightmap_values{"heightmap.values", "1", "values of a heightmap at its nodes"};
inline constexpr Key<std::uint32_t> heightmap_columns{"heightmap.columns", "1", "nodes of a heightmap along x"};
/// Array: corners of the convex hull of the mesh, in the frame of its file.
inline constexpr Key<Vec3> mesh_corners{"mesh.corners", "m", "corners of the convex hull of a mesh, in its own frame"};

// Sensors, drives and names of materials that a model file brings. A robot does not keep these properties.
/// Array on the base. Each text is one subsystem, written as in a scenario:
/// `lidar: {use: laser.embree, on: base_link, rate: 10}`. A text without `use`, named `motion`, holds parameters of the
/// robot's motions. Values of the scenario have priority.
inline constexpr Key<TextId> model_subsystems{"model.subsystems", "1", "array: subsystems that the model brings"};
/// Array on the base: line and column of each subsystem in the model's file, from 1; 0: unknown.
inline constexpr Key<std::int32_t> model_subsystem_places{"model.subsystems.places", "1",
                                                          "array: line and column of each of model.subsystems"};
/// Array on a body: the name of the material of each of its `visual.shapes`, in their order; no_text: no name. A user
/// replaces materials by these names.
inline constexpr Key<TextId> visual_materials{"visual.materials", "1",
                                              "array: names of the materials of visual.shapes"};

}  // namespace muro::keys
