// SPDX-License-Identifier: MIT
// Whether a robot stands on something when a run begins.
#pragma once

#include <vector>

#include "muro/toolkit/bounds.hpp"
#include "muro/toolkit/mass_properties.hpp"

namespace muro {

/// The collision shapes of a scene at the start, as boxes along the axes of the world; planes are themselves. What is
/// in the file of a mesh is not known here: a robot that has one, or is asked about one, counts as touching it.
class InitialContact {
 public:
  /// [setup]
  explicit InitialContact(const Connector& c) {
    for (std::uint32_t i = 0; i < c.object_count(); ++i) {
      const ObjectId object{i};
      if (c.robot_of(object) < 0) add(c, object, -1, c.constant(object, keys::pose).value_or(Pose{}));
    }
    for (const RobotView* robot : c.robots()) {
      if (c.constant(robot->base(), keys::shadow_of)) continue;
      const std::vector<double> positions = initial_joint_positions(c, *robot);
      std::vector<Pose> poses(robot->links.size());
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const Link& link = robot->links[i];
        poses[i] = i == 0 ? c.constant(link.object, keys::initial_pose).value_or(Pose{})
                          : poses[std::size_t(link.parent)] * pose_in_parent(link, positions[i]);
        add(c, link.object, std::int32_t(robot->number), poses[i]);
      }
    }
  }

  /// Whether a shape of the robot overlaps, or is within 1 mm of, one of another robot or of scenery.
  bool touches(const RobotView& robot) const {
    const auto own = std::int32_t(robot.number);
    for (const Box& a : boxes_) {
      if (a.robot != own) continue;
      for (const Box& b : boxes_)
        if (b.robot != own && (a.is_mesh || b.is_mesh || a.bounds.overlaps(b.bounds))) return true;
      for (const Pose& plane : planes_)
        if (distance(a.bounds, plane) < margin) return true;
    }
    return false;
  }

 private:
  static constexpr double margin = 1e-3;  ///< m
  struct Box {
    Aabb bounds;  ///< with half the margin
    std::int32_t robot = -1;
    bool is_mesh = false;
  };

  void add(const Connector& c, ObjectId object, std::int32_t robot, const Pose& body) {
    for (const Shape& shape : c.constant_array(object, keys::collision_shapes)) {
      const Pose pose = body * shape.origin;
      if (shape.kind == ShapeKind::plane) {
        planes_.push_back(pose);
        continue;
      }
      Aabb bounds = bounds_of(shape, pose);
      if (shape.kind == ShapeKind::heightmap) {  // solid below its surface, which is no higher than its value 1
        bounds.low.z() = -std::numeric_limits<double>::infinity();
        bounds.high.z() += shape.size.z();
      }
      const Vec3 half_margin = Vec3::Constant(0.5 * margin);
      boxes_.push_back({{bounds.low - half_margin, bounds.high + half_margin}, robot, shape.kind == ShapeKind::mesh});
    }
  }
  /// m, of the nearest corner of a box from a plane; below 0 behind it.
  static double distance(const Aabb& box, const Pose& plane) {
    const Vec3 normal = plane.orientation * Vec3::UnitZ();
    const Vec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    return normal.dot(middle - plane.position) - normal.cwiseAbs().dot(half);
  }

  std::vector<Box> boxes_;
  std::vector<Pose> planes_;
};

}  // namespace muro
