// SPDX-License-Identifier: MIT
// Shapes with a closed form as a user geometry of Embree.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "plugins/common/render/scene_bodies.hpp"

namespace muro::embree {

/// A shape on a body, with its pose at the last update.
struct BodyShape {
  Shape shape;
  scene_bodies::SceneBody body;
  Vec3 position = Vec3::Zero();      ///< position of the shape, m
  Mat3 to_shape = Mat3::Identity();  ///< rotation from the axes of the world to those of the shape

  Pose pose() const { return body.pose() * shape.origin; }
  void update();
  /// Returns the distance (m) along a ray in the world to its first point in the shape: 0 for a ray that starts in it,
  /// infinity if the ray misses it.
  double distance(const Vec3& origin, const Vec3& direction) const;
};

/// The rays of one cast. Embree searches with them in single precision; shapes are intersected with these values.
struct RayQuery {
  RTCIntersectContext context;  ///< must be the first member: Embree passes its address on
  Vec3 origin;
  const Vec3* directions = nullptr;  ///< in the world
  double* ranges = nullptr;          ///< m, the shortest so far
  ObjectId* objects = nullptr;       ///< that was hit at this range
  RobotId ignored_robot = no_robot;
  const RobotId* robot_of_instance = nullptr;  ///< by geometry
};

/// Shapes that Embree finds by their bounding boxes.
class UserGeometry {
 public:
  /// Adds itself to a scene.
  void attach(RTCDevice device, RTCScene scene, std::vector<BodyShape> shapes);
  /// Takes the present poses. The scene must be committed afterwards.
  void update();

 private:
  static void bounds(const RTCBoundsFunctionArguments* a);
  static void intersect(const RTCIntersectFunctionNArguments* a);

  std::vector<BodyShape> shapes_;
  RTCGeometry geometry_ = nullptr;
};

}  // namespace muro::embree
