// SPDX-License-Identifier: MIT
#include "box_columns.hpp"

#include <algorithm>

namespace muro::raycast {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void empty(Boxes& b, std::size_t i) {
  for (int k = 0; k < 3; ++k) {
    b.low[k][i] = infinity;
    b.high[k][i] = -infinity;
  }
  b.item[i] = 0;
}

}  // namespace

void BoxColumns::reserve(std::size_t most, const Vec3& centre) {
  blocks_.resize((most + Boxes::size - 1) / Boxes::size);
  groups_.resize((blocks_.size() + Boxes::size - 1) / Boxes::size);
  centre_ = centre;
}

void BoxColumns::clear() {
  count_ = 0;
  extent_ = 0;
}

void BoxColumns::add(const Aabb& box, std::uint32_t item) {
  Boxes& b = blocks_[count_ / Boxes::size];
  const std::size_t i = count_++ % Boxes::size;
  for (int k = 0; k < 3; ++k) {
    b.low[k][i] = float(box.low[k] - centre_[k]);
    b.high[k][i] = float(box.high[k] - centre_[k]);
    extent_ = std::max({extent_, -b.low[k][i], b.high[k][i]});
  }
  b.item[i] = item;
}

void BoxColumns::close() {
  for (std::size_t i = count_; i < Boxes::size * blocks_.size(); ++i) empty(blocks_[i / Boxes::size], i % Boxes::size);
  for (std::size_t i = 0; i < Boxes::size * groups_.size(); ++i) {
    Boxes& group = groups_[i / Boxes::size];
    empty(group, i % Boxes::size);
    if (i >= blocks_.size()) continue;
    for (int k = 0; k < 3; ++k) {
      group.low[k][i % Boxes::size] = *std::min_element(blocks_[i].low[k], blocks_[i].low[k] + Boxes::size);
      group.high[k][i % Boxes::size] = *std::max_element(blocks_[i].high[k], blocks_[i].high[k] + Boxes::size);
    }
  }
}

BoxTable BoxColumns::view() const {
  BoxTable table;
  table.groups = groups_.data();
  table.blocks = blocks_.data();
  table.group_count = std::uint32_t(groups_.size());
  for (int k = 0; k < 3; ++k) table.centre[k] = centre_[k];
  table.extent = extent_;
  return table;
}

}  // namespace muro::raycast
