// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lanes/bounds.hpp"
#include "muro/robot.hpp"
#include "muro/shape.hpp"

namespace muro::native {

/// The points within `ball` of a box in the axes of a frame of a robot.
struct FrameBox {
  std::uint32_t frame = 0;
  Vec3 centre = Vec3::Zero();  ///< m
  Vec3 half = Vec3::Zero();    ///< m
  double ball = 0;             ///< m
};

/// The box that a shape of frame `frame` stays in, in the foremost frame that can have one which is hardly larger: a
/// wheel's in its carrier, for it stays in its place however far it has turned; an arm's in the arm. `follows[i]`: the
/// pose of frame i is exactly what the joints make of its parent's.
FrameBox swept_box(std::span<const Link> frames, const std::vector<bool>& follows, std::uint32_t frame,
                   const Shape& shape);

/// One box a frame around all boxes of it, in order of frames.
std::vector<FrameBox> joined(std::vector<FrameBox> boxes);

}  // namespace muro::native
