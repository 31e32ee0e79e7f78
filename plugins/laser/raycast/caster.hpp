// SPDX-License-Identifier: MIT
#pragma once

#include "cull.hpp"

namespace muro::raycast {

/// Casts the rays of one scan after the other. Keeps nothing but memory between scans, so that any thread may serve
/// any scanner; one caster serves one thread.
class Caster {
 public:
  /// Room for scenes of this size (shapes, nodes of a hierarchy), so that casting does not allocate.
  void reserve(std::size_t colliders, std::size_t nodes);

  /// The distance (m) along each ray to the nearest shape, between `min_range` and view.max_range, and, when `hits`
  /// is not empty, the object that the shape belongs to (no_object for nothing). Both are as long as the pattern.
  void cast(const SceneIndex& scene, const View& view, double min_range, const Pattern& pattern,
            std::span<double> ranges, std::span<ObjectId> hits);

 private:
  struct Nearest;
  void cast_bundle(const Bundle& bundle, Nearest& nearest) const;

  Candidates candidates_;
  ConeList in_sector_;
};

}  // namespace muro::raycast
