// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/laser/common/scanner/method.hpp"
#include "ray_pattern.hpp"
#include "scene_table.hpp"

namespace muro::raycast {

using scanner::Viewpoint;

/// Casts the rays of one scan after the other. Keeps only scratch memory between scans, so that any thread can serve
/// any scanner. One caster serves one thread.
class RayCaster {
 public:
  /// Reserves memory for the scene and the pattern, so that casting does not allocate.
  void reserve(const SceneTable& scene, const RayPattern& pattern);

  /// Finds the distance (m) along each ray to the nearest shape, between min_range and max_range. If `hits` is not
  /// empty, also finds the object of that shape (no_object if there is none). Both are as long as the pattern. A device
  /// with a pose that is not finite sees nothing. [step]
  void cast(const ScanKernels& kernels, const SceneTable& scene, const Viewpoint& from, const RayPattern& pattern,
            std::span<double> ranges, std::span<ObjectId> hits);

 private:
  std::vector<RelativeBoxes> boxes_;
  std::vector<CandidateRef> order_;
  std::vector<Candidates> in_range_, in_sector_;
  std::vector<RobotCandidate> robots_;
  std::vector<PlacedPrimitive> placed_;
  std::vector<PlaneCandidate> planes_;
  std::vector<PlacedHeightmap> heightmaps_;
  std::vector<std::int64_t> ids_;
};

}  // namespace muro::raycast
