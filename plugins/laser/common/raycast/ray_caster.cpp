// SPDX-License-Identifier: MIT
#include "ray_caster.hpp"

#include <algorithm>

#include "plugins/laser/common/scanner/scratch.hpp"

namespace muro::raycast {

namespace {

ScanQuery query_of(const Viewpoint& from, const RayPattern& pattern) {
  ScanQuery q;
  const Mat3 axes = from.device.orientation.toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    q.position[k] = from.device.position[k];
    for (int i = 0; i < 3; ++i) q.axes[3 * k + i] = axes(k, i);
  }
  q.min_range = from.min_range;
  q.max_range = from.max_range;
  q.ignored_robot = index_of(from.ignored_robot);
  q.packets = pattern.packets().data();
  q.sectors = pattern.sectors().data();
  q.sector_count = std::uint32_t(pattern.sectors().size());
  q.min_slope = pattern.min_slope();
  q.max_slope = pattern.max_slope();
  return q;
}

}  // namespace

void RayCaster::reserve(const SceneTable& scene, const RayPattern& pattern) {
  const std::size_t blocks = scene.block_count();
  scanner::scratch(boxes_, blocks);
  scanner::scratch(order_, BoxBlock::size * blocks);
  scanner::scratch(in_range_, blocks + 1);
  scanner::scratch(in_sector_, blocks + 1);
  scanner::scratch(robots_, scene.robot_count());
  scanner::scratch(placed_, scene.primitive_count());
  scanner::scratch(planes_, scene.plane_count());
  scanner::scratch(heightmaps_, scene.heightmap_count());
  scanner::scratch(ids_, pattern.size());
}

void RayCaster::cast(const ScanKernels& kernels, const SceneTable& scene, const Viewpoint& from,
                     const RayPattern& pattern, std::span<double> ranges, std::span<ObjectId> hits) {
  if (!from.device.position.allFinite() || !from.device.orientation.coeffs().allFinite()) {
    std::fill(ranges.begin(), ranges.end(), from.max_range);
    std::fill(hits.begin(), hits.end(), no_object);
    return;
  }
  reserve(scene, pattern);
  scene.place_heightmaps(from.device.position, heightmaps_.data());
  const Scratch scratch{boxes_.data(),     order_.data(),      in_range_.data(),
                        in_sector_.data(), robots_.data(),     placed_.data(),
                        planes_.data(),    heightmaps_.data(), std::uint32_t(scene.heightmap_count())};
  const ScanOutput output{ranges.data(), hits.empty() ? nullptr : ids_.data()};
  kernels.cast(scene.view(), query_of(from, pattern), scratch, output);
  for (std::size_t i = 0; i < hits.size(); ++i) hits[i] = scene.body(ids_[i]);
}

}  // namespace muro::raycast
