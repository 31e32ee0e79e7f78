// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <unordered_map>
#include <variant>
#include <vector>

#include "muro/geometry.hpp"

namespace muro::host {

/// A disc on the ground that a robot occupies.
struct Footprint {
  double x, y, radius;  ///< m
};
/// The outline of scenery: a rectangle in the plane of its pose.
struct Obstacle {
  Pose pose;
  double half_x, half_y;  ///< m
};

/// The occupied ground. It is a hierarchy of grids, one for each size (Teschner et al., Optimized spatial hashing,
/// 2003), so that a search only checks near items.
class Occupancy {
 public:
  void add(const Footprint& footprint);
  void add(const Obstacle& obstacle);
  /// Whether `footprint` keeps `clearance` (m) to all items.
  bool is_free(const Footprint& footprint, double clearance) const;

 private:
  struct Cell {
    std::int64_t x, y;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      return (std::uint64_t(c.x) * 0x9E3779B97F4A7C15ull) ^ (std::uint64_t(c.y) * 0xBF58476D1CE4E5B9ull);
    }
  };
  using Item = std::variant<Footprint, Obstacle>;
  /// Items with circles that are not larger than a cell; each is in the cell of its centre.
  struct Level {
    double cell;  ///< m, the side of a cell
    std::vector<Item> items;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  };

  void add(const Item& item, double x, double y, double radius);

  std::unordered_map<int, Level> levels_;  ///< by exponent of the cell size
  std::vector<Item> large_;                ///< items without bounds
};

}  // namespace muro::host
