// SPDX-License-Identifier: MIT
// Which shapes can a scanner see at all: gathered once a scan, then narrowed from sector to bundle.
#pragma once

#include <array>
#include <vector>

#include "muro/scene.hpp"
#include "pattern.hpp"

namespace muro::raycast {

/// From where and how far a scanner looks.
struct View {
  Pose device;                      ///< in the world
  double max_range = 0;             ///< m
  std::int32_t ignored_robot = -1;  ///< the number of a robot that is not seen; -1: none
};

/// A bounded shape in reach, seen from the device.
struct Candidate {
  ShapeKind kind = ShapeKind::box;
  ObjectId body = no_object;
  double sx = 0, sy = 0, sz = 0;  ///< what the kernel takes: half lengths, or radius, -, half length
  Vec3 origin;                    ///< m, of the device in the frame of the shape
  std::array<double, 9> turn{};  ///< row by row: direction in the frame of the shape = turn * direction in the device's
  Vec3 centre;                   ///< m, in the frame of the device
  Mat3 reach;                    ///< m, columns: half axes of the box around the shape, in the frame of the device
};

/// A plane, seen from the device.
struct PlaneCandidate {
  ObjectId body = no_object;
  Vec3 normal;        ///< in the frame of the device
  double height = 0;  ///< m, of the device above the plane
};

/// The cones around a set of candidates, nearest first, in columns for comparison with the cone of rays.
class ConeList {
 public:
  static constexpr std::size_t block = 8;  ///< columns are read in blocks; the last is filled up

  std::size_t size() const { return size_; }
  void reserve(std::size_t count);
  void clear() { size_ = 0; }
  void push_back(const Cone& cone, double near, std::uint32_t candidate);
  /// Copies element `i` of another list.
  void push_back(const ConeList& from, std::size_t i);
  double near(std::size_t i) const { return near_[i]; }  ///< m, no ray meets the candidate before
  std::uint32_t candidate(std::size_t i) const { return candidate_[i]; }
  /// margins[j] >= 0 where element `first + j` may have a direction in common with `cone`. Two cones with half
  /// angles a and b meet when the angle between their axes is at most a + b.
  void may_meet(const Cone& cone, std::size_t first, double (&margins)[block]) const;

 private:
  std::size_t size_ = 0;
  std::vector<double> x_, y_, z_, cosine_, sine_, near_;
  std::vector<std::uint32_t> candidate_;
};

/// All shapes that rays of one scan may hit.
class Candidates {
 public:
  /// Room for `colliders` shapes, so that `gather` does not allocate.
  void reserve(std::size_t colliders, std::size_t nodes);
  /// Searches the index for what is nearer than view.max_range and crosses the pattern's band of elevations. Meshes
  /// are left out. [step]
  void gather(const SceneIndex& scene, const View& view, const Pattern& pattern);

  const Candidate& operator[](std::uint32_t i) const { return shapes_[i]; }
  const ConeList& cones() const { return cones_; }
  const std::vector<PlaneCandidate>& planes() const { return planes_; }

 private:
  struct Place {
    double near;
    std::uint32_t collider;  ///< orders candidates at equal distance
    std::uint32_t candidate;
  };
  template <class Visit>
  void search(const Bvh& tree, Visit visit);
  void consider(const SceneIndex& scene, std::uint32_t collider, const Pattern& pattern);
  double distance2(const Aabb& box) const;

  View view_;
  Mat3 to_device_;  ///< turns directions of the world into the device's frame
  std::vector<Candidate> shapes_;
  std::vector<PlaneCandidate> planes_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> stack_;
  ConeList cones_;
};

}  // namespace muro::raycast
