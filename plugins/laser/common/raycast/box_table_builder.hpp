// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"
#include "scene_view.hpp"

namespace muro::raycast {

/// Builds a BoxTable box by box, and owns its memory. Boxes that follow each other should be near each other.
class BoxTableBuilder {
 public:
  /// Reserves memory for `capacity` boxes, with coordinates relative to `centre`.
  void reserve(std::size_t capacity, const Vec3& centre);
  void clear();
  void add(const Aabb& box, std::uint32_t item);
  /// Completes the table. Call it after the last box.
  void finish();

  BoxTable table() const;
  std::size_t block_count() const { return blocks_.size(); }

 private:
  std::vector<BoxBlock> blocks_, groups_;
  Vec3 centre_ = Vec3::Zero();
  std::size_t count_ = 0;
  float extent_ = 0;
};

}  // namespace muro::raycast
