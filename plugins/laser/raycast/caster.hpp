// SPDX-License-Identifier: MIT
#pragma once

#include "pattern.hpp"
#include "plugins/common/scanner/method.hpp"
#include "scene_table.hpp"

namespace muro::raycast {

using scanner::View;

/// Casts the rays of one scan after the other. Keeps nothing but memory between scans, so that any thread may serve
/// any scanner; one caster serves one thread.
class Caster {
 public:
  /// Room for the scene and the pattern, so that casting does not allocate.
  void reserve(const SceneTable& scene, const Pattern& pattern);

  /// The distance (m) along each ray to the nearest shape, between min_range and max_range, and, when `hits` is not
  /// empty, the object that the shape belongs to (no_object for nothing). Both are as long as the pattern. A device
  /// whose pose is not finite sees nothing. [step]
  void cast(const ScanKernels& kernels, const SceneTable& scene, const View& view, const Pattern& pattern,
            std::span<double> ranges, std::span<ObjectId> hits);

 private:
  std::vector<Found> found_;
  std::vector<Place> order_;
  std::vector<Candidates> in_reach_, in_sector_;
  std::vector<Visitor> visitors_;
  std::vector<Placed> placed_;
  std::vector<Fall> falls_;
  std::vector<std::int64_t> ids_;
};

}  // namespace muro::raycast
