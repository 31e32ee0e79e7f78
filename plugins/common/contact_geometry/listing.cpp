// SPDX-License-Identifier: MIT
#include "listing.hpp"

#include <cmath>

namespace muro::encounters {

Contact contact_between(const Collider& own, const Collider& other) {
  Contact c;
  c.self = own.body;
  c.other = other.body;
  c.self_shape = own.shape_index;
  c.other_shape = other.shape_index;
  c.friction = std::sqrt(own.shape->friction * other.shape->friction);
  c.restitution = std::max(own.shape->restitution, other.shape->restitution);
  return c;
}

}  // namespace muro::encounters
