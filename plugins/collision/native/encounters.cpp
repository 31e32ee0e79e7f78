// SPDX-License-Identifier: MIT
#include "encounters.hpp"

#include "pairs/collide.hpp"
#include "plugins/common/contact_geometry/listing.hpp"

namespace muro::native {

void Encounters::list_contacts(const ListOut<Contact>& list) const {
  for (auto own = own_.begin(), own_end = own; own != own_.end(); own = own_end) {
    own_end = end_of_body(own, own_.end());
    for (auto other = others_.begin(), other_end = other; other != others_.end(); other = other_end) {
      other_end = end_of_body(other, others_.end());
      for (auto a = own; a != own_end; ++a)
        for (auto b = other; b != other_end; ++b) touch(*a, *b, list);
    }
  }
}

void Encounters::touch(const Near& own, const Other& other, const ListOut<Contact>& list) {
  // A robot's own plane is touched by those that have a list themselves.
  if (own.placed.kind == ShapeKind::plane && !other.has_list) return;
  if (!own.bounds.overlaps(other.bounds)) return;
  Manifold manifold;
  if (other.mirrored) {
    collide(other.placed, own.placed, manifold);
    manifold.flip();
  } else {
    collide(own.placed, other.placed, manifold);
  }
  if (manifold.count == 0) return;
  Contact c = contact_between(*own.collider, *other.collider);
  for (int i = 0; i < manifold.count; ++i) {
    c.point = manifold.points[i].point;
    c.normal = manifold.points[i].normal;
    c.depth = manifold.points[i].depth;
    list.push_back(c);
  }
}

}  // namespace muro::native
