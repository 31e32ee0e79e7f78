// SPDX-License-Identifier: MIT
// A scene on the graphics processor. To be made and used while the context is current.
#pragma once

#include <array>
#include <vector>

#include "camera.hpp"
#include "scene.hpp"

namespace muro::render {

/// Inward planes about the eye, normal and distance: the sides of what is seen, and what lies ahead.
using Frustum = std::array<Eigen::Vector4d, 5>;

/// From places about the eye, in the axes of the world, to what the rasteriser wants. Depth is near / distance, from 1
/// down to 0 at infinity: so single precision is spread evenly over distances.
Eigen::Matrix4d projection_of(const Camera& camera);
Frustum frustum_of(const Camera& camera);

class Stage {
 public:
  explicit Stage(const Scene& scene);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Takes over where everything is now.
  void place();
  /// Chooses what is inside of the planes and nearer than `reach` (m) to `eye` (m), as it was placed.
  void collect(const Vec3& eye, const Frustum& frustum, double reach, std::int32_t ignored_robot);
  /// Draws what was chosen, with the program in use: shaders::place_vertex.
  void draw() const;

 private:
  /// One piece as the vertex shader gets it.
  struct Instance {
    std::array<float, 12> place{};  ///< rows of a 3x4 matrix: from the surface to the world, about the eye
    std::array<float, 3> color{};
    std::uint32_t label = 0;
    float pattern = 0;  ///< 1: coordinates of the picture, or tiles, are metres of the world
  };
  /// A surface in the buffers.
  struct Part {
    std::uint32_t first_index = 0, indices = 0;
    std::int32_t first_vertex = 0;
    std::uint32_t picture = 0;
  };
  struct Placed {
    Vec3 at;    ///< m
    Mat3 turn;  ///< from the surface to the world, with its scale
  };
  /// Pieces of one robot, or one of scenery, and a ball around them.
  struct Group {
    std::uint32_t first = 0, count = 0;
    std::int32_t robot = -1;
    Vec3 middle = Vec3::Zero();
    double radius = 0;
  };

  void make_groups();
  void enclose(Group& group) const;
  void add(const Vec3& eye, std::uint32_t piece, double reach);

  const Scene* scene_;
  std::vector<Group> groups_;  ///< of scenery first
  std::size_t moving_ = 0;     ///< the first of a robot
  bool is_placed_ = false;
  std::vector<Placed> placed_;                    ///< one a piece
  std::vector<Part> parts_;                       ///< one a surface
  std::vector<std::vector<Instance>> collected_;  ///< one a surface
  std::vector<Instance> upload_;
  std::vector<std::uint32_t> pictures_;  ///< textures; 0: a white one
  std::uint32_t vertices_ = 0, indices_ = 0, instances_ = 0, array_ = 0;
  std::size_t room_ = 0;  ///< instances that the buffer holds
};

}  // namespace muro::render
