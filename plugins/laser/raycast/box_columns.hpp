// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/scene.hpp"
#include "sight.hpp"

namespace muro::raycast {

/// A BoxTable that is filled box by box; neighbours should be neighbours in space.
class BoxColumns {
 public:
  /// Room for `most` boxes, with coordinates that count from `centre`.
  void reserve(std::size_t most, const Vec3& centre);
  void clear();
  void add(const Aabb& box, std::uint32_t item);
  /// After the last box.
  void close();

  BoxTable view() const;
  std::size_t block_count() const { return blocks_.size(); }

 private:
  std::vector<Boxes> blocks_, groups_;
  Vec3 centre_ = Vec3::Zero();
  std::size_t count_ = 0;
  float extent_ = 0;
};

}  // namespace muro::raycast
