// SPDX-License-Identifier: MIT
// Surface of a pair of shapes, by the same rule in all backends.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// The rule by which the friction of a pair follows from those of its two shapes.
enum class FrictionRule : std::uint32_t {
  min,      ///< as in Gazebo (ODE)
  mean,     ///< geometric: the root of the product, as in Box2D and Jolt
  product,  ///< as in Bullet
  max,      ///< as in MuJoCo
};

/// Returns the friction rule of the world; `min` when it has none. [setup]
inline FrictionRule friction_rule_of(Connector& c) {
  return static_cast<FrictionRule>(c.constant(world_object, keys::friction_rule).value_or(0));
}

/// Friction of the pair by the rule; restitution and resistances are the larger of the two. The order of the shapes
/// does not change a bit.
inline Surface pair_surface(const Surface& a, const Surface& b, FrictionRule rule) {
  Surface s;
  switch (rule) {
    case FrictionRule::min:
      s.friction = std::min(a.friction, b.friction);
      break;
    case FrictionRule::mean:
      s.friction = std::sqrt(a.friction * b.friction);
      break;
    case FrictionRule::product:
      s.friction = a.friction * b.friction;
      break;
    case FrictionRule::max:
      s.friction = std::max(a.friction, b.friction);
      break;
  }
  s.restitution = std::max(a.restitution, b.restitution);
  s.rolling_resistance = std::max(a.rolling_resistance, b.rolling_resistance);
  s.spinning_resistance = std::max(a.spinning_resistance, b.spinning_resistance);
  return s;
}

}  // namespace muro
