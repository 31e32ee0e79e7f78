// SPDX-License-Identifier: MIT
#pragma once

#include "pairs/depth_function.hpp"

namespace muro::native {

enum class Relation {
  apart,   ///< the distance is larger than the ball
  near,    ///< the distance is less than the ball; `direction` is near the minimum of the depth function
  inside,  ///< they overlap even without the ball, or touch within rounding
};

struct Separation {
  Relation relation;
  Vec3 direction;  ///< unit, the last estimate of the direction of that minimum; only with `near`
};

/// Returns whether two shapes are apart, by the distance of the origin from their Minkowski difference, which is a
/// DepthFunction or a CorePair. Method: Gilbert, Johnson, Keerthi: A fast procedure for computing the distance between
/// complex objects in three-dimensional space, IEEE J. Robotics and Automation 4(2), 1988. The nearest point of the
/// simplex is found by its Voronoi regions (Ericson, Real-Time Collision Detection, 5.1 and 9.5).
template <class Difference>
Separation separation(const Difference& h);

}  // namespace muro::native
