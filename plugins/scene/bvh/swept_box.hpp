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

/// Returns the box in which a shape of link number `link` stays while the joints move. The box moves with the link
/// nearest to the root for which it is hardly larger than the shape: with the carrier for a wheel, which stays in its
/// place while it rotates, and with the arm for a part of an arm. `follows[i]`: parent and joint alone determine the
/// pose of link i.
LinkBox swept_box(std::span<const Link> links, const std::vector<bool>& follows, std::uint32_t link,
                  const Shape& shape);

/// Merges the boxes of each link, in the order of links.
std::vector<LinkBox> merged(std::vector<LinkBox> boxes);

}  // namespace muro::bvh
