// SPDX-License-Identifier: MIT
// Ground that carries vehicles that move without forces.
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

/// Heightmaps and planes among the collision shapes of the scenery. If several lie one over the other, the highest is
/// the ground, because all below a surface is solid. Surfaces that face down or sideways (more than 84 deg off) are not
/// ground.
class Terrain {
 public:
  /// Reads the heightmaps at the first call. [setup]
  void connect(const Connector& c);

  bool has_heightmaps() const { return !tiles_.empty(); }
  /// Returns the shapes of the scenery that are ground, in the order of objects. [setup]
  const std::vector<ShapeOfObject>& shapes() const { return shapes_; }
  /// Returns the shortest side of a cell (m); infinite without heightmaps.
  double resolution() const { return resolution_; }

  /// Returns the ground; nothing beyond the rims of all heightmaps if there is no plane. [step]
  std::optional<Ground> ground_at(double x, double y) const;

 private:
  struct Tile {
    Heightmap map;
    Pose shape, inverse;  ///< pose of the map's frame in the world; of the world in the map's frame
    bool is_level = true;
    double cosine = 1, sine = 0;              ///< of the yaw, if the map is level
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
