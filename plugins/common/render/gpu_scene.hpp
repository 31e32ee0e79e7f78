// SPDX-License-Identifier: MIT
// A scene on the GPU. Must be made and used while the context is current.
#pragma once

#include <array>
#include <vector>

#include "camera.hpp"
#include "scene.hpp"

namespace muro::render {

/// Planes relative to the camera, inward normal and distance: the four sides of the view, and the plane of the camera.
using Frustum = std::array<Eigen::Vector4d, 5>;

/// Returns the matrix from positions relative to the camera, in the axes of the world, to clip space. Depth is near /
/// distance, from 1 down to 0 at infinity (reversed z), which spreads the precision of floats evenly over distances.
Eigen::Matrix4d projection_of(const Camera& camera);
Frustum frustum_of(const Camera& camera);

class GpuScene {
 public:
  explicit GpuScene(const Scene& scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  /// Reads the present poses of all bodies.
  void update();
  /// Selects the instances inside of the frustum and nearer than `range` (m) to `eye` (m, the camera's position), with
  /// the poses of the last update.
  void cull(const Vec3& eye, const Frustum& frustum, double range, RobotId ignored_robot);
  /// Draws what was selected, with the program in use: shaders::instance_vertex.
  void draw() const;

 private:
  /// An instance in the form of the vertex shader.
  struct InstanceData {
    std::array<float, 12> transform{};  ///< rows of a 3x4 matrix: from the surface to the world, relative to the camera
    std::array<float, 3> color{};
    std::uint32_t label = 0;
    float in_metres = 0;  ///< 1: texture coordinates, or tiles, are metres of the world
  };
  /// A surface in the buffers.
  struct SurfaceRange {
    std::uint32_t first_index = 0, indices = 0;
    std::int32_t first_vertex = 0;
    std::uint32_t texture = 0;
    std::uint32_t sampler = 0;  ///< 0: that of the texture
  };
  struct Transform {
    Vec3 position;  ///< m
    Mat3 matrix;    ///< from the surface to the world, with its scale
  };
  /// Instances of one robot, or one instance of scenery, and their bounding sphere.
  struct Group {
    std::uint32_t first = 0, count = 0;
    RobotId robot = no_robot;
    Vec3 centre = Vec3::Zero();
    double radius = 0;
  };

  void upload_surfaces();
  void describe_attributes();
  void make_groups();
  void enclose(Group& group) const;
  void add(const Vec3& eye, std::uint32_t instance, double range);

  const Scene* scene_;
  std::vector<Group> groups_;    ///< those of scenery first
  std::size_t first_robot_ = 0;  ///< the first group of a robot
  bool is_scenery_placed_ = false;
  std::vector<Transform> transforms_;  ///< of each instance
  std::vector<SurfaceRange> surfaces_;
  std::vector<std::vector<InstanceData>> selected_;  ///< of each surface
  std::vector<InstanceData> upload_;
  std::vector<std::uint32_t> textures_;  ///< element 0: a white texture
  std::uint32_t edge_sampler_ = 0;       ///< for textures that do not repeat
  std::uint32_t vertex_buffer_ = 0, index_buffer_ = 0, instance_buffer_ = 0, vertex_array_ = 0;
  std::size_t capacity_ = 0;  ///< instances that the buffer holds
};

}  // namespace muro::render
