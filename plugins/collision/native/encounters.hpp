// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/handles.hpp"
#include "muro/scene.hpp"
#include "pairs/placed.hpp"
#include "plugins/common/contact_geometry/manifold.hpp"

namespace muro::native {

/// A collider at its place.
struct Near {
  const Collider* collider = nullptr;
  Placed placed;
  Aabb bounds;
};

/// What a robot may touch, in the order of its list of contacts, and the search of that pair by pair. Reused, so that
/// it stops allocating.
class Encounters {
 public:
  /// Begins with the robot's own colliders.
  void start(const Aabb& bounds) {
    bounds_ = bounds;
    own_.clear();
    others_.clear();
  }
  /// Bodies in the order of the model, shapes in the order of the body.
  void add_own(const Near& own) { own_.push_back(own); }
  /// Colliders of a body one behind the other. `mirrored`: the pair is worked out as the other sees it, and turned
  /// round; of two robots that list each other's contacts one mirrors the other's.
  void add_other(const Near& other, bool mirrored, bool has_list) { others_.push_back({other, mirrored, has_list}); }
  const Aabb& bounds() const { return bounds_; }
  std::size_t others() const { return others_.size(); }

  /// Adds all contacts, ordered by own body, other body, own shape, other shape.
  void list_contacts(const ListOut<Contact>& list) const;

 private:
  struct Other : Near {
    bool mirrored;
    bool has_list;
  };
  static void touch(const Near& own, const Other& other, const ListOut<Contact>& list);

  Aabb bounds_;
  std::vector<Near> own_;
  std::vector<Other> others_;
};

}  // namespace muro::native
