// SPDX-License-Identifier: MIT
// Properties of cameras.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

// Cameras: properties of the sensor's object; x is forward, as in every sensor frame here.
inline constexpr Key<std::uint32_t> camera_width{"camera.width", "1", "pixels"};
inline constexpr Key<std::uint32_t> camera_height{"camera.height", "1", "pixels"};
inline constexpr Key<double> camera_horizontal_fov{"camera.horizontal_fov", "rad", "opening angle"};
inline constexpr Key<double> camera_fx{"camera.fx", "px", "focal length across"};
inline constexpr Key<double> camera_fy{"camera.fy", "px", "focal length down"};
inline constexpr Key<double> camera_cx{"camera.cx", "px", "column of the optical axis, from the left edge"};
inline constexpr Key<double> camera_cy{"camera.cy", "px", "row of the optical axis, from the upper edge"};
inline constexpr Key<std::uint8_t> camera_image{"camera.image", "1", "array: rgb, rows from the top"};
inline constexpr Key<float> camera_depth{"camera.depth", "m",
                                         "array: distance along the optical axis, infinite where nothing is"};
inline constexpr Key<ObjectId> camera_labels{"camera.labels", "1", "array: the object each pixel shows, or none"};

}  // namespace muro::keys
