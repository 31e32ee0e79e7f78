// SPDX-License-Identifier: MIT
#include "box_table_builder.hpp"

#include <algorithm>

namespace muro::raycast {

namespace {

void make_empty(BoxBlock& b, std::size_t i) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    b.low[k][i] = infinity;
    b.high[k][i] = -infinity;
  }
  b.item[i] = 0;
}

}  // namespace

void BoxTableBuilder::reserve(std::size_t capacity, const Vec3& centre) {
  blocks_.resize((capacity + BoxBlock::size - 1) / BoxBlock::size);
  groups_.resize((blocks_.size() + BoxBlock::size - 1) / BoxBlock::size);
  centre_ = centre;
}

void BoxTableBuilder::clear() {
  count_ = 0;
  extent_ = 0;
}

void BoxTableBuilder::add(const Aabb& box, std::uint32_t item) {
  BoxBlock& b = blocks_[count_ / BoxBlock::size];
  const std::size_t i = count_++ % BoxBlock::size;
  for (int k = 0; k < 3; ++k) {
    b.low[k][i] = float(box.low[k] - centre_[k]);
    b.high[k][i] = float(box.high[k] - centre_[k]);
    extent_ = std::max({extent_, -b.low[k][i], b.high[k][i]});
  }
  b.item[i] = item;
}

void BoxTableBuilder::finish() {
  for (std::size_t i = count_; i < BoxBlock::size * blocks_.size(); ++i)
    make_empty(blocks_[i / BoxBlock::size], i % BoxBlock::size);
  for (std::size_t i = 0; i < BoxBlock::size * groups_.size(); ++i) {
    BoxBlock& group = groups_[i / BoxBlock::size];
    make_empty(group, i % BoxBlock::size);
    if (i >= blocks_.size()) continue;
    for (int k = 0; k < 3; ++k) {
      group.low[k][i % BoxBlock::size] = *std::min_element(blocks_[i].low[k], blocks_[i].low[k] + BoxBlock::size);
      group.high[k][i % BoxBlock::size] = *std::max_element(blocks_[i].high[k], blocks_[i].high[k] + BoxBlock::size);
    }
  }
}

BoxTable BoxTableBuilder::table() const {
  BoxTable t;
  t.groups = groups_.data();
  t.blocks = blocks_.data();
  t.group_count = std::uint32_t(groups_.size());
  for (int k = 0; k < 3; ++k) t.centre[k] = centre_[k];
  t.extent = extent_;
  return t;
}

}  // namespace muro::raycast
