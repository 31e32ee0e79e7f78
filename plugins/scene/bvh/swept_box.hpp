// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/robot.hpp"
#include "muro/shape.hpp"

namespace muro::bvh {

/// Points within the distance `ball` of a box along the axes of a link.
struct LinkBox {
  std::uint32_t link = 0;
  Vec3 centre = Vec3::Zero();  ///< m
  Vec3 half = Vec3::Zero();    ///< m
  double ball = 0;             ///< m
};

/// The box that a shape of link number `link` stays in while the joints move, in the first link on the way from the
/// root that can have one which is hardly larger: a wheel's in its carrier, for it stays in its place however far it
/// has rotated; an arm's in the arm. `follows[i]`: the pose of link i is exactly what its joint makes of its parent's.
LinkBox swept_box(Rows<Link> links, const std::vector<bool>& follows, std::uint32_t link, const Shape& shape);

/// Merges the boxes of each link, in the order of links.
std::vector<LinkBox> merged(std::vector<LinkBox> boxes);

}  // namespace muro::bvh
