// SPDX-License-Identifier: MIT
// Shapes with a closed form, as a user geometry of Embree.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "muro/handles.hpp"
#include "muro/shape.hpp"

namespace muro::embree {

/// A shape on a body, and where it is.
struct Solid {
  Shape shape;
  In<Pose> body;  ///< of a robot; unset for scenery
  Pose place;     ///< of the body, of scenery
  ObjectId object = no_object;
  std::int32_t robot = -1;       ///< number; -1: scenery
  Vec3 at = Vec3::Zero();        ///< of the shape, m
  Mat3 back = Mat3::Identity();  ///< from the axes of the world to those of the shape

  Pose pose() const { return (body ? *body : place) * shape.origin; }
  void update();
  /// The distance (m) along a ray in the world to its first point: 0 in it, infinity when the ray misses it.
  double distance(const Vec3& origin, const Vec3& direction) const;
};

/// The rays of one call: Embree searches with them in single precision, solids are met by what is here.
struct Rays {
  RTCIntersectContext context;  ///< the first member: Embree hands its address on
  Vec3 origin;
  const Vec3* directions = nullptr;  ///< in the world
  double* ranges = nullptr;          ///< m, the least so far
  ObjectId* objects = nullptr;       ///< whose it is
  std::int32_t ignored_robot = -1;
  const std::int32_t* robot_of_instance = nullptr;  ///< by geometry
};

/// Solids that Embree finds by their boxes.
class SolidGeometry {
 public:
  /// Adds itself to a scene.
  void attach(RTCDevice device, RTCScene scene, std::vector<Solid> solids);
  /// Takes over where everything is now, which a commit of the scene then follows.
  void update();
  bool empty() const { return solids_.empty(); }

 private:
  static void bounds(const RTCBoundsFunctionArguments* a);
  static void intersect(const RTCIntersectFunctionNArguments* a);

  std::vector<Solid> solids_;
  RTCGeometry geometry_ = nullptr;
};

}  // namespace muro::embree
