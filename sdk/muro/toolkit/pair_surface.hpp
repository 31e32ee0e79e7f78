// SPDX-License-Identifier: MIT
// What the surfaces of two shapes are to each other, by the same rule in all backends.
#pragma once

#include <algorithm>
#include <cmath>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// How the friction of a pair follows from those of its two shapes.
enum class FrictionRule : std::uint32_t {
  min,      ///< as Gazebo (ODE) does
  mean,     ///< geometric: the root of the product, as Box2D and Jolt do
  product,  ///< as Bullet does
  max,      ///< as MuJoCo does
};

/// Of the world; the smaller where nothing is said. [setup]
inline FrictionRule friction_rule_of(Connector& c) {
  return static_cast<FrictionRule>(c.constant(world_object, keys::friction_rule).value_or(0));
}

/// The friction of the pair by the rule; restitution and resistances are the larger of the two. The order does not
/// matter, to the bit.
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
