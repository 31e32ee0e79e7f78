// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/laser/common/scanner/method.hpp"
#include "user_geometry.hpp"

namespace muro::embree {

/// Distances by Embree: exact for shapes with a closed form, in single precision for the triangles of meshes and
/// heightmaps.
class Embree final : public scanner::Method {
 public:
  Embree();
  ~Embree() override;

  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void update() override;
  void cast(std::size_t set, const scanner::Viewpoint& from, std::span<double> ranges,
            std::span<ObjectId> hits) override;
  bool is_parallel() const override { return true; }
  bool is_cheap_for_few_rays() const override { return true; }

 private:
  struct MeshInstance {
    BodyShape shape;
    RTCGeometry geometry = nullptr;
  };

  /// Receives the errors of Embree. [any thread]
  static void keep_error(void* self, RTCError code, const char* text) noexcept;
  /// Throws Error if a call of Embree has failed.
  void check() const;
  void add(Connector& c, const BodyShape& shape);
  /// Returns the scene of a mesh or a heightmap. Returns null if it was refused: see mesh::refuse_collision_mesh.
  RTCScene mesh(Connector& c, const BodyShape& s);
  RTCScene build(const mesh::Mesh& mesh);
  /// Returns the heightmap with a point of the world (m) in the solid below its surface; no object if there is none.
  ObjectId ground_around(const Vec3& point) const;
  void place(const MeshInstance& instance) const;
  static void skip_ignored_robot(const RTCFilterFunctionNArguments* a);
  /// Intersects shapes and meshes, sixteen rays at a time.
  void intersect_scene(RayQuery& query, std::uint32_t count, double max_range) const;
  void intersect_planes(const RayQuery& query, std::uint32_t count) const;

  std::atomic<bool> has_failed_ = false;
  mutable std::mutex mutex_;
  std::string error_;  ///< message of the first error
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::map<std::tuple<std::string, double, double, double>, RTCScene> meshes_;  ///< scenes by file and scale
  std::vector<BodyShape> scenery_shapes_, robot_shapes_, planes_;
  std::vector<MeshInstance> mesh_instances_;
  heightmap::Store heightmaps_;
  std::vector<BodyShape> heightmap_shapes_;
  std::vector<Heightmap> heightmap_surfaces_;  ///< surfaces of heightmap_shapes_, in the frames of the shapes
  UserGeometry scenery_, robots_;
  std::vector<RobotId> robot_of_;    ///< by geometry of the scene
  std::vector<ObjectId> object_of_;  ///< object of each geometry of the scene
  std::vector<scanner::RaySet> sets_;
  bool is_built_ = false;
};

}  // namespace muro::embree
