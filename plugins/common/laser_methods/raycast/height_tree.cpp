// SPDX-License-Identifier: MIT
#include "height_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"

namespace muro::raycast {

namespace {

/// Heights, m; none where it is empty.
struct Range {
  float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
};

float rounded_down(double x) { return std::nextafter(float(x), -std::numeric_limits<float>::infinity()); }
float rounded_up(double x) { return std::nextafter(float(x), std::numeric_limits<float>::infinity()); }

HeightNode node_of(const Range (&children)[16]) {
  Range all;
  for (const Range& child : children) all = {std::min(all.low, child.low), std::max(all.high, child.high)};
  HeightNode node;
  node.low = all.low;
  node.step = std::max((all.high - all.low) / 254, std::numeric_limits<float>::min());
  for (std::size_t i = 0; i < 16; ++i) {
    if (children[i].low > children[i].high) continue;
    const auto steps = [&](float height) { return double(height - node.low) / double(node.step); };
    node.lowest[i] = std::uint8_t(std::clamp(std::floor(steps(children[i].low)), 0.0, 255.0));
    node.highest[i] = std::uint8_t(std::clamp(std::ceil(steps(children[i].high)), 0.0, 255.0));
  }
  return node;
}

}  // namespace

HeightTree::HeightTree(heightmap::HeightmapFile file, const Vec3& size)
    : file_(std::move(file)), size_(size), bounds_(heightmap::bounds_of(heightmap())) {
  std::uint32_t columns = file_.columns - 1, rows = file_.rows - 1;  // of what the level divides
  const Heightmap map = heightmap();
  const auto bounds_of_cell = [&](std::uint32_t column, std::uint32_t row) {
    const auto value = [&](std::uint32_t c, std::uint32_t r) { return map.values[std::size_t(r) * map.columns + c]; };
    const auto [low, high] =
        std::minmax({value(column, row), value(column + 1, row), value(column, row + 1), value(column + 1, row + 1)});
    const bool has_wall = column == 0 || row == 0 || column == columns - 1 || row == rows - 1;
    return Range{rounded_down(has_wall ? bounds_.low.z() : size_.z() * double(low)),
                 rounded_up(size_.z() * double(high))};
  };
  const auto bounds_of_node = [&](std::uint32_t node) {
    const HeightNode& n = nodes_.back()[node];
    return Range{n.low, n.low + n.step * *std::max_element(n.highest, n.highest + 16)};
  };
  do {
    const std::uint32_t wide = (columns + 3) / 4, deep = (rows + 3) / 4;
    std::vector<HeightNode> nodes(std::size_t(wide) * deep);
    for (std::uint32_t row = 0; row < deep; ++row)
      for (std::uint32_t column = 0; column < wide; ++column) {
        Range children[16];
        for (std::uint32_t i = 0; i < 16; ++i) {
          const std::uint32_t c = 4 * column + i % 4, r = 4 * row + i / 4;
          if (c >= columns || r >= rows) continue;
          children[i] = nodes_.empty() ? bounds_of_cell(c, r) : bounds_of_node(r * columns + c);
        }
        nodes[std::size_t(row) * wide + column] = node_of(children);
      }
    nodes_.push_back(std::move(nodes));
    levels_.push_back({nodes_.back().data(), columns, rows});
    columns = wide, rows = deep;
  } while (columns > 1 || rows > 1);
}

HeightField HeightTree::field() const {
  HeightField f;
  f.values = file_.values.data();
  f.columns = file_.columns;
  f.scale = size_.z();
  f.low = bounds_.low.z();
  const Heightmap map = heightmap();
  f.spacing[0] = map.spacing_x(), f.spacing[1] = map.spacing_y();
  f.half[0] = 0.5 * size_.x(), f.half[1] = 0.5 * size_.y();
  f.extent = std::max({f.half[0], f.half[1], std::abs(f.low), std::abs(bounds_.high.z())});
  f.levels = levels_.data();
  f.level_count = std::uint32_t(levels_.size());
  return f;
}

void HeightTrees::connect(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& shape : c.constant_array(ObjectId(i), keys::collision_shapes)) {
      if (shape.kind != ShapeKind::heightmap || trees_.contains(key_of(shape))) continue;
      try {
        add(shape, heightmap::load(std::string(c.text(shape.mesh))));
      } catch (const Error& error) {
        mesh::refuse_collision_mesh(c, ObjectId(i), error);
        trees_.emplace(key_of(shape), nullptr);
      }
    }
}

void HeightTrees::add(const Shape& shape, heightmap::HeightmapFile file) {
  trees_.insert_or_assign(key_of(shape), std::make_unique<HeightTree>(std::move(file), shape.size));
}

const HeightTree* HeightTrees::find(const Shape& shape) const {
  const auto found = trees_.find(key_of(shape));
  return found == trees_.end() ? nullptr : found->second.get();
}

}  // namespace muro::raycast
