// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "muro/simd/rows.hpp"
#include "plugins/common/contact_geometry/body_frame.hpp"
#include "plugins/common/contact_geometry/pose_location.hpp"

namespace muro::native {

using contact_geometry::PoseLocation, contact_geometry::RobotPoses;

/// Copy of muro::ShapeKind, because kernels cannot include its header.
enum class KernelShapeKind : std::uint32_t { box, sphere, cylinder, capsule, plane, mesh, heightmap };

/// A shape in its body, as plain numbers.
struct KernelShape {
  KernelShapeKind kind = KernelShapeKind::box;
  std::uint32_t body = 0;  ///< index among the robot's bodies with shapes, from 0
  PoseLocation pose;       ///< location of the pose of that body
  /// Half size (m). Box: half lengths. Sphere: the radius three times. Cylinder, capsule: radius, radius, half the
  /// length along z (capsule: of its straight part). Plane: unused. Mesh, heightmap: half lengths of the box around it.
  double half[3] = {};
  double centre[3] = {};  ///< m, in the body
  double axes[9] = {};    ///< of the shape in the body, column by column
  /// Axes of the shape that are axes of the body. Axis k of the shape is axis |along[k]| - 1 of the body, opposite if
  /// negative. 0: it is no axis of the body.
  int along[3] = {};
  bool is_centred = false;  ///< `centre` is 0
  /// Vertices of the hull of a mesh: x, y, z of each (m, in the body).
  const double* vertices = nullptr;
  int vertex_count = 0;

  /// Whether it is a sphere or cylinder.
  MURO_INLINE bool is_round() const { return kind == KernelShapeKind::sphere || kind == KernelShapeKind::cylinder; }
  /// Returns an upper bound (m) of the distance of its points from the origin of its body.
  MURO_INLINE double reach() const {
    return __builtin_sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]) +
           (kind == KernelShapeKind::capsule ? half[0] : 0) +
           __builtin_sqrt(centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]);
  }
  /// Whether the orientation of the body matters.
  MURO_INLINE bool needs_orientation() const { return kind != KernelShapeKind::sphere || !is_centred; }

  friend bool operator==(const KernelShape&, const KernelShape&) = default;
};

/// A plane of the scenery; the solid side is below, against the normal (unit).
struct GroundPlane {
  double normal[3] = {0, 0, 1};
  double origin[3] = {};
  bool is_level = true;  ///< the normal is z
};

struct TerrainGrid;
/// A plane of the scenery, or a heightmap.
struct Ground {
  GroundPlane plane;
  const TerrainGrid* terrain = nullptr;  ///< null: `plane` is used
};

namespace lanes {
inline namespace MURO_ISA {

// hides ::abs and similar names
using contact_geometry::BodyFrame;
using lane::abs, lane::any, lane::as_read, lane::bits, lane::count_of, lane::load, lane::MaskOf, lane::max, lane::min,
    lane::Places, lane::select, lane::sqrt, lane::V3;

/// A shape in the world.
template <class S>
class ShapeInWorld {
 public:
  ShapeInWorld(const KernelShape& shape, const BodyFrame<S>& body) : shape_(shape), body_(body) {}

  KernelShapeKind kind() const { return shape_.kind; }
  const double* half() const { return shape_.half; }
  /// Centre of the shape (m, world).
  MURO_INLINE V3<S> centre() const {
    return shape_.is_centred ? body_.position() : body_.position() + body_.rotated(shape_.centre);
  }
  /// Axis k of the shape, in the world.
  MURO_INLINE V3<S> axis(int k) const {
    const int along = shape_.along[k];
    if (along == 0) return body_.rotated(shape_.axes + 3 * k);
    return along > 0 ? body_.axis(along - 1) : -body_.axis(-along - 1);
  }

 private:
  const KernelShape& shape_;
  const BodyFrame<S>& body_;
};

}  // namespace MURO_ISA
}  // namespace lanes
}  // namespace muro::native
