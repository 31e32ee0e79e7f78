// SPDX-License-Identifier: MIT
#include "caster.hpp"

#include <algorithm>

#include "plugins/common/scanner/memory.hpp"

namespace muro::raycast {

namespace {

Scanner scanner_of(const View& view, const Pattern& pattern) {
  Scanner s;
  const Mat3 axes = view.device.orientation.toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    s.position[k] = view.device.position[k];
    for (int i = 0; i < 3; ++i) s.axes[3 * k + i] = axes(k, i);
  }
  s.min_range = view.min_range;
  s.max_range = view.max_range;
  s.ignored_robot = view.ignored_robot;
  s.bundles = pattern.bundles().data();
  s.sectors = pattern.sectors().data();
  s.sector_count = std::uint32_t(pattern.sectors().size());
  s.min_slope = pattern.min_slope();
  s.max_slope = pattern.max_slope();
  return s;
}

}  // namespace

void Caster::reserve(const SceneTable& scene, const Pattern& pattern) {
  const std::size_t blocks = scene.block_count();
  scanner::grown(found_, blocks);
  scanner::grown(order_, Boxes::size * blocks);
  scanner::grown(in_reach_, blocks + 1);
  scanner::grown(in_sector_, blocks + 1);
  scanner::grown(visitors_, scene.robot_count());
  scanner::grown(placed_, scene.solid_count());
  scanner::grown(falls_, scene.plane_count());
  scanner::grown(ids_, pattern.size());
}

void Caster::cast(const ScanKernels& kernels, const SceneTable& scene, const View& view, const Pattern& pattern,
                  std::span<double> ranges, std::span<ObjectId> hits) {
  if (!view.device.position.allFinite() || !view.device.orientation.coeffs().allFinite()) {
    std::fill(ranges.begin(), ranges.end(), view.max_range);
    std::fill(hits.begin(), hits.end(), no_object);
    return;
  }
  reserve(scene, pattern);
  const Memory memory{found_.data(),    order_.data(),  in_reach_.data(), in_sector_.data(),
                      visitors_.data(), placed_.data(), falls_.data()};
  const Reading reading{ranges.data(), hits.empty() ? nullptr : ids_.data()};
  kernels.cast(scene.sight(), scanner_of(view, pattern), memory, reading);
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = scene.body(ids_[i]);
}

}  // namespace muro::raycast
