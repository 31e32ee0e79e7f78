// SPDX-License-Identifier: MIT
// Frames of bodies as matrices, for code that needs places and inertias of all bodies of a robot in each step.
#pragma once

#include "muro/robot.hpp"
#include "plugins/common/lanes/turn.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro {

/// Pose of a body in the frame of the base.
struct BodyFrame {
  lane::M3<double> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  lane::V3<double> origin{0, 0, 0};  ///< m

  MURO_INLINE lane::V3<double> at(const lane::V3<double>& point) const { return origin + axes * point; }
};

/// Computes the place of the body that a joint moves.
class JointFrame {
 public:
  JointFrame() = default;
  explicit JointFrame(const Link& link)
      : kind_(link.joint),
        is_turned_(link.origin.orientation.coeffs() != Quat::Identity().coeffs()),
        turn_(columns_of(link.origin.orientation.toRotationMatrix())),
        offset_(plain(link.origin.position)),
        axis_(plain(link.axis)) {}

  JointKind kind() const { return kind_; }
  /// Places the body. `parent`: frame of the parent body; `position`: rad or m; `axis`: out, axis of the joint in the
  /// frame of the base.
  MURO_INLINE BodyFrame place(const BodyFrame& parent, double position, lane::V3<double>& axis) const {
    BodyFrame f{is_turned_ ? parent.axes * turn_ : parent.axes, parent.at(offset_)};
    axis = f.axes * axis_;
    if (kind_ == JointKind::revolute)
      f.axes = f.axes * rotation(position);
    else if (kind_ == JointKind::prismatic)
      f.origin += position * axis;
    return f;
  }

 private:
  /// Rotation about the axis (Rodrigues).
  MURO_INLINE lane::M3<double> rotation(double angle) const {
    const auto [c, s] = lane::turn_by(angle);
    const lane::V3<double>&a = axis_, b = (1 - c) * a, d = s * a;
    return {{c + b.x * a.x, b.x * a.y + d.z, b.x * a.z - d.y},
            {b.y * a.x - d.z, c + b.y * a.y, b.y * a.z + d.x},
            {b.z * a.x + d.y, b.z * a.y - d.x, c + b.z * a.z}};
  }

  JointKind kind_ = JointKind::fixed;
  bool is_turned_ = false;
  lane::M3<double> turn_{};
  lane::V3<double> offset_{}, axis_{};
};

/// Returns `tensor` with its axes turned by `axes`.
MURO_INLINE lane::M3<double> turned_by(const lane::M3<double>& axes, const lane::M3<double>& tensor) {
  const lane::M3<double> t = axes * tensor;
  return {t.x * axes.x.x + t.y * axes.y.x + t.z * axes.z.x, t.x * axes.x.y + t.y * axes.y.y + t.z * axes.z.y,
          t.x * axes.x.z + t.y * axes.y.z + t.z * axes.z.z};
}

/// Adds the tensor of inertia of a point of `mass` (kg, may be below 0) at `r` (m), about the origin.
MURO_INLINE void add_point(double mass, const lane::V3<double>& r, lane::M3<double>& to) {
  const lane::V3<double> p = mass * r;
  const double square = dot(p, r);
  to.x += {square - p.x * r.x, -(p.y * r.x), -(p.z * r.x)};
  to.y += {-(p.x * r.y), square - p.y * r.y, -(p.z * r.y)};
  to.z += {-(p.x * r.z), -(p.y * r.z), square - p.z * r.z};
}

}  // namespace muro
