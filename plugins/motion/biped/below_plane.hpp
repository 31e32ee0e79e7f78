// SPDX-License-Identifier: MIT
// Links other than feet that are below the plane. The motion does not keep them above it, but reports them.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "ground_plane.hpp"
#include "muro/base/bounds.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::biped {

/// Boxes around the collision shapes of the links of one robot, without those of feet and without meshes.
class LinksBelowPlane {
 public:
  LinksBelowPlane() = default;
  /// Connects the links after the joints of the robot have got their properties. `is_left_out`: one per link. [setup]
  LinksBelowPlane(Connector& c, const RobotView& robot, const std::vector<bool>& is_left_out) : robot_(&robot) {
    for (std::uint32_t i = 0; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      parts_.emplace_back();
      if (link.joint != JointKind::fixed) parts_[i].position = c.write(link.joint_object, keys::joint_position);
      if (is_left_out[i]) continue;
      parts_[i].name = c.object_name(link.object);
      for (const Shape& s : c.constant_array(link.object, keys::collision_shapes))
        if (s.kind != ShapeKind::mesh && s.kind != ShapeKind::plane && s.kind != ShapeKind::heightmap)
          parts_[i].shapes.push_back(s);
    }
  }

  /// Reports the first link that is deeper than 1 mm, once for all robots that share the flag. `base`: pose of the base
  /// of the robot. [step]
  void tell(Host& host, const GroundPlane& plane, const Pose& base, std::atomic<bool>& is_told) {
    if (is_told.load(std::memory_order_relaxed)) return;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      const Link& link = robot_->links[i];
      part.pose =
          i == 0 ? base
                 : parts_[std::size_t(link.parent)].pose * pose_in_parent(link, part.position ? *part.position : 0);
      for (const Shape& s : part.shapes) {
        const double depth = -lowest(s, part.pose * s.origin, plane);
        if (depth < least_depth || is_told.exchange(true)) continue;
        host.log(LogLevel::warning, quote(part.name) + " is " + std::to_string(depth) +
                                        " m below the plane on which the robot walks; motion.biped keeps feet above "
                                        "it and no other links (others that do so are not told)");
        return;
      }
    }
  }

 private:
  static constexpr double least_depth = 1e-3;  ///< m
  struct Part {
    Out<double> position;  ///< position of the joint that leads to it
    std::vector<Shape> shapes;
    std::string_view name;
    Pose pose;  ///< used within a step
  };

  /// Returns the height (m) of the lowest point of a shape at `pose` above the plane; of the box around the shape.
  static double lowest(const Shape& shape, const Pose& pose, const GroundPlane& plane) {
    if (shape.kind == ShapeKind::sphere) return plane.height(pose.position) - shape.size.x();
    const Vec3 along = (pose.orientation.conjugate() * plane.normal).cwiseAbs();
    return plane.height(pose.position) - along.dot(half_extents(shape));
  }

  const RobotView* robot_ = nullptr;
  std::vector<Part> parts_;  ///< one per link
};

}  // namespace muro::biped
