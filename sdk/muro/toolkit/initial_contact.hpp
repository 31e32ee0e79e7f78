// SPDX-License-Identifier: MIT
// A check whether a robot touches something when a run begins.
#pragma once

#include <algorithm>
#include <functional>
#include <tuple>
#include <vector>

#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/support.hpp"

namespace muro {

/// Returns the vertices (m) of the convex hull of a shape's mesh, scaled, in the frame of the shape; empty when they
/// are unknown. [setup]
using MeshVertices = std::function<std::vector<Vec3>(const Connector& c, const Shape& shape)>;

/// The collision shapes of a scene at the start. Against planes they count with their exact shape (meshes as convex
/// hulls), against each other as boxes along the axes of the world. A mesh whose vertices are unknown counts as
/// touching, for its own robot and for the others.
class InitialContact {
 public:
  /// [setup]
  explicit InitialContact(const Connector& c, const MeshVertices& vertices = {}) {
    std::vector<MeshFile> files;
    for (std::uint32_t i = 0; i < c.object_count(); ++i) {
      const ObjectId object{i};
      if (c.robot_of(object) == no_robot)
        add(c, vertices, files, object, no_robot, c.constant(object, keys::pose).value_or(Pose{}));
    }
    for (const RobotView* robot : c.robots()) {
      if (c.constant(robot->base(), keys::shadow_of)) continue;
      const std::vector<double> positions = initial_joint_positions(c, *robot);
      std::vector<Pose> poses(robot->links.size());
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const Link& link = robot->links[i];
        poses[i] = i == 0 ? c.constant(link.object, keys::initial_pose).value_or(Pose{})
                          : poses[std::size_t(link.parent)] * pose_in_parent(link, positions[i]);
        add(c, vertices, files, link.object, robot->id, poses[i]);
      }
    }
  }

  /// Whether a shape of the robot overlaps a shape of another robot or of scenery, or is within 1 mm of it.
  bool touches(const RobotView& robot) const {
    for (const Box& a : boxes_) {
      if (a.robot != robot.id) continue;
      for (const Box& b : boxes_)
        if (b.robot != robot.id && (a.is_unknown || b.is_unknown || a.bounds.overlaps(b.bounds))) return true;
      for (const Pose& plane : planes_)
        if (distance(a, plane) < margin) return true;
    }
    return false;
  }

 private:
  static constexpr double margin = 1e-3;  ///< m
  static constexpr std::int32_t no_mesh = -1;
  struct Box {
    Aabb bounds;  ///< with half the margin
    RobotId robot = no_robot;
    bool is_unknown = false;      ///< it is a mesh whose vertices are not known
    std::int32_t mesh = no_mesh;  ///< in meshes_
    Shape shape;
    Pose pose;  ///< pose of the shape
  };
  /// File and scale of a mesh; its place in the list is its index in meshes_.
  using MeshFile = std::tuple<TextId, double, double, double>;

  std::int32_t mesh_of(const Connector& c, const MeshVertices& vertices, std::vector<MeshFile>& files,
                       const Shape& shape) {
    const MeshFile file{shape.mesh, shape.size.x(), shape.size.y(), shape.size.z()};
    const auto known = std::find(files.begin(), files.end(), file);
    const auto number = std::int32_t(known - files.begin());
    if (known != files.end()) return number;
    files.push_back(file);
    meshes_.push_back(vertices ? vertices(c, shape) : std::vector<Vec3>{});
    return number;
  }

  void add(const Connector& c, const MeshVertices& vertices, std::vector<MeshFile>& files, ObjectId object,
           RobotId robot, const Pose& body) {
    const Vec3 half_margin = Vec3::Constant(0.5 * margin);
    for (const Shape& shape : c.constant_array(object, keys::collision_shapes)) {
      const Pose pose = body * shape.origin;
      if (shape.kind == ShapeKind::plane) {
        planes_.push_back(pose);
        continue;
      }
      Box box{.bounds = bounds_of(shape, pose), .robot = robot, .shape = shape, .pose = pose};
      Aabb& bounds = box.bounds;
      if (shape.kind == ShapeKind::heightmap) {  // solid below its surface, which is not higher than its value 1
        bounds.low.z() = -std::numeric_limits<double>::infinity();
        bounds.high.z() += shape.size.z();
      }
      if (shape.kind == ShapeKind::mesh) {
        box.mesh = mesh_of(c, vertices, files, shape);
        bounds = {};
        for (const Vec3& v : meshes_[std::size_t(box.mesh)]) bounds.include({pose * v, pose * v});
        box.is_unknown = meshes_[std::size_t(box.mesh)].empty();
      }
      bounds = {bounds.low - half_margin, bounds.high + half_margin};
      boxes_.push_back(box);
    }
  }
  /// Distance (m) of the nearest point from a plane (0 for a mesh whose vertices are unknown); below 0 behind it.
  double distance(const Box& box, const Pose& plane) const {
    const Vec3 normal = plane.orientation * Vec3::UnitZ();
    if (box.is_unknown) return 0;
    if (box.mesh != no_mesh) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& v : meshes_[std::size_t(box.mesh)])
        nearest = std::min(nearest, normal.dot(box.pose * v - plane.position));
      return nearest;
    }
    return normal.dot(box.pose.position - plane.position) -
           support(box.shape, box.pose.orientation.conjugate() * Vec3(-normal));
  }

  std::vector<Box> boxes_;
  std::vector<Pose> planes_;
  std::vector<std::vector<Vec3>> meshes_;  ///< vertices by index of the file, in the frame of the shape
};

}  // namespace muro
