// SPDX-License-Identifier: MIT
// The ground that carries what moves without forces.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "muro/connector.hpp"
#include "muro/toolkit/contact_stop.hpp"
#include "muro/toolkit/heightmap.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"

namespace muro::ground {

/// The ground above or below a point of the world.
struct Ground {
  double height = 0;                ///< m
  double slope_x = 0, slope_y = 0;  ///< of the height by x and y of the world
};

/// The heightmaps and planes among the collision shapes of the scenery. Where several lie one over the other, the
/// highest is the ground, as what is below a surface is solid. Surfaces that look down or sideways (more than 84 deg
/// off) are no ground.
class Terrain {
 public:
  /// Reads the heightmaps, when it is called first. [setup]
  void connect(const Connector& c);

  bool has_heightmaps() const { return !tiles_.empty(); }
  /// Of the scenery, what is ground, in the order of objects. [setup]
  const std::vector<ShapeOfObject>& shapes() const { return shapes_; }
  /// m: the shortest side of a cell; infinite without heightmaps.
  double resolution() const { return resolution_; }

  /// Nothing beyond the rims of all heightmaps where there is no plane. [step]
  std::optional<Ground> ground_at(double x, double y) const;

 private:
  struct Tile {
    Heightmap map;
    Pose shape, inverse;  ///< of the map's frame in the world; of the world in the map's frame
    bool is_level = true;
    double cosine = 1, sine = 0;              ///< of the yaw of one that is level
    double cells_per_x = 1, cells_per_y = 1;  ///< 1/m

    Tile(const Heightmap& m, const Pose& pose);
    std::optional<Ground> ground_at(double x, double y) const;
    std::optional<Ground> ground_of_level(double x, double y) const;
  };
  struct Plane {
    Vec3 point, normal;
  };

  void add(const Connector& c, const ShapeOfObject& where, const Shape& shape, const Pose& pose);

  heightmap::Store files_;
  std::vector<Tile> tiles_;
  std::vector<Plane> planes_;
  std::vector<ShapeOfObject> shapes_;
  double resolution_ = std::numeric_limits<double>::infinity();
  bool is_connected_ = false;
};

}  // namespace muro::ground
