// SPDX-License-Identifier: MIT
#include "height_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"

namespace muro::raycast {

namespace {

constexpr std::uint32_t block = HeightField::block;

/// A plane: height in m, slopes in m per block.
struct Slope {
  double height, x, y;
  double at(double over_x, double over_y) const { return height + x * over_x + y * over_y; }
};

/// Returns the slope along x of a least-squares fit to equally spaced nodes with the heights height(column, row).
template <class Height>
double slope_of(std::uint32_t columns, std::uint32_t rows, const Height& height) {
  const double middle = 0.5 * (columns - 1);
  double sum = 0, squares = 0;
  for (std::uint32_t c = 0; c < columns; ++c) {
    squares += (c - middle) * (c - middle) * rows;
    for (std::uint32_t r = 0; r < rows; ++r) sum += (c - middle) * height(c, r);
  }
  return sum / squares;
}

}  // namespace

/// Makes the planes of a heightmap, level by level. Units are blocks and m.
class HeightPlanes {
 public:
  HeightPlanes(const Heightmap& map, std::vector<HeightPlane>& planes) : map_(map), planes_(planes) {
    wide_ = (map.columns - 2) / block + 1, deep_ = (map.rows - 2) / block + 1;
    double steepest = 0, highest = 0;
    for (std::uint32_t r = 0; r < map.rows; ++r)
      for (std::uint32_t c = 0; c < map.columns; ++c) {
        highest = std::max(highest, std::abs(height(c, r)));
        if (c > 0) steepest = std::max(steepest, std::abs(height(c, r) - height(c - 1, r)));
        if (r > 0) steepest = std::max(steepest, std::abs(height(c, r) - height(c, r - 1)));
      }
    step = steepest > 0 ? steepest * block / 32767 : 1;
    // rays are followed in floats within the box around the map
    margin_along_ = 1e-6 * (std::max(wide_, deep_) + 2.0);
    margin_up_ = 8e-6 * highest + 1e-8;
    while ((1u << levels_) < std::min(wide_, deep_)) ++levels_;
    widest = 1u << levels_;
    upper_column = wide_, upper_rows = (deep_ + widest - 1) / widest * widest;
    columns = wide_ + (levels_ > 0 ? (wide_ + 1) / 2 : 0);
    planes_.assign(std::size_t(columns) * upper_rows, {});
    for (std::uint32_t j = 0; j < deep_; ++j)
      for (std::uint32_t i = 0; i < wide_; ++i) planes_[number(0, i, j)] = over_nodes(i, j);
    for (std::uint32_t level = 1; level <= levels_; ++level)
      for (std::uint32_t j = 0; j < size(deep_, level); ++j)
        for (std::uint32_t i = 0; i < size(wide_, level); ++i) planes_[number(level, i, j)] = over_planes(level, i, j);
  }
  double step;  ///< unit of slopes, m per block
  std::uint32_t columns, upper_column, upper_rows, widest;

 private:
  static std::uint32_t size(std::uint32_t blocks, std::uint32_t level) { return ((blocks - 1) >> level) + 1; }
  std::size_t number(std::uint32_t level, std::uint32_t i, std::uint32_t j) const {
    const std::size_t first_row = level == 0 ? 0 : upper_rows - (2 * upper_rows >> level);
    return (first_row + j) * columns + (level == 0 ? 0 : upper_column) + i;
  }
  double height(std::uint32_t c, std::uint32_t r) const {
    return map_.size.z() * double(map_.values[std::size_t(r) * map_.columns + c]);
  }

  HeightPlane over_nodes(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t c0 = i * block, r0 = j * block;
    const std::uint32_t across = std::min(2 * block, map_.columns - 1 - c0) + 1,
                        along = std::min(2 * block, map_.rows - 1 - r0) + 1;
    Slope s{-std::numeric_limits<double>::infinity(), 0, 0};
    s.x = rounded(block * slope_of(across, along, [&](auto c, auto r) { return height(c0 + c, r0 + r); }));
    s.y = rounded(block * slope_of(along, across, [&](auto r, auto c) { return height(c0 + c, r0 + r); }));
    for (std::uint32_t r = 0; r < along; ++r)
      for (std::uint32_t c = 0; c < across; ++c)
        s.height = std::max(s.height, height(c0 + c, r0 + r) - (s.x * c + s.y * r) / block);
    s.height += (std::abs(s.x) + std::abs(s.y)) * margin_along_ + margin_up_;
    return plane_of(s);
  }
  HeightPlane over_planes(std::uint32_t level, std::uint32_t i, std::uint32_t j) const {
    const double part = 1u << (level - 1);  // length of a block of the level below
    std::uint32_t part_i[2], part_j[2];
    for (std::uint32_t k = 0; k < 2; ++k) {
      part_i[k] = std::min(2 * i + 2 * k, size(wide_, level - 1) - 1);
      part_j[k] = std::min(2 * j + 2 * k, size(deep_, level - 1) - 1);
    }
    Slope parts[2][2];
    double middle[2][2];
    for (std::uint32_t k = 0; k < 2; ++k)
      for (std::uint32_t l = 0; l < 2; ++l) {
        const HeightPlane& p = planes_[number(level - 1, part_i[k], part_j[l])];
        parts[k][l] = {double(p.height), p.slope_x * step, p.slope_y * step};
        middle[k][l] = parts[k][l].at(part, part);
      }
    const double away_x = (part_i[1] - part_i[0]) * part, away_y = (part_j[1] - part_j[0]) * part;
    Slope s{-std::numeric_limits<double>::infinity(), parts[0][0].x, parts[0][0].y};
    if (away_x > 0) s.x = (middle[1][0] + middle[1][1] - middle[0][0] - middle[0][1]) / (2 * away_x);
    if (away_y > 0) s.y = (middle[0][1] + middle[1][1] - middle[0][0] - middle[1][0]) / (2 * away_y);
    s.x = rounded(s.x), s.y = rounded(s.y);
    for (std::uint32_t k = 0; k < 2; ++k)
      for (std::uint32_t l = 0; l < 2; ++l)
        for (const double x : {0.0, 2 * part})
          for (const double y : {0.0, 2 * part})
            s.height = std::max(s.height, parts[k][l].at(x, y) - s.x * (part_i[k] * part - 2 * i * part + x) -
                                              s.y * (part_j[l] * part - 2 * j * part + y));
    s.height += (std::abs(s.x) + std::abs(s.y)) * margin_along_ + 1e-6 * margin_up_;
    return plane_of(s);
  }
  double rounded(double slope) const { return step * std::round(std::clamp(slope / step, -32767.0, 32767.0)); }
  HeightPlane plane_of(const Slope& s) const {
    return {std::nextafter(float(s.height), std::numeric_limits<float>::infinity()),
            std::int16_t(std::lround(s.x / step)), std::int16_t(std::lround(s.y / step))};
  }

  const Heightmap& map_;
  std::vector<HeightPlane>& planes_;
  std::uint32_t wide_, deep_, levels_ = 0;  // numbers of blocks, the last block may be incomplete
  double margin_along_, margin_up_;         // blocks, m
};

HeightTree::HeightTree(heightmap::HeightmapFile file, const Vec3& size)
    : file_(std::move(file)), size_(size), bounds_(heightmap::bounds_of(heightmap())) {
  const Heightmap map = heightmap();
  const HeightPlanes made(map, planes_);
  plane_columns_ = made.columns, upper_column_ = made.upper_column, upper_rows_ = made.upper_rows;
  widest_ = made.widest;
  slope_step_ = made.step;
}

HeightField HeightTree::field() const {
  HeightField f;
  f.values = file_.values.data();
  f.columns = file_.columns;
  f.rows = file_.rows;
  f.scale = size_.z();
  f.low = bounds_.low.z();
  f.high = bounds_.high.z();
  const Heightmap map = heightmap();
  f.spacing[0] = map.spacing_x(), f.spacing[1] = map.spacing_y();
  f.half[0] = 0.5 * size_.x(), f.half[1] = 0.5 * size_.y();
  f.planes = planes_.data();
  f.plane_columns = plane_columns_, f.upper_column = upper_column_, f.upper_rows = upper_rows_;
  f.widest = widest_;
  f.slope_step = slope_step_;
  f.blocks[0] = double(f.columns - 1) / block, f.blocks[1] = double(f.rows - 1) / block;
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
