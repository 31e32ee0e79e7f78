// SPDX-License-Identifier: MIT
#pragma once

#include "muro/simd/rows.hpp"

namespace muro::contact_geometry {
inline namespace MURO_ISA {

/// Frame of a body in the world, over a double or SIMD lanes of robots. Axes are computed when they are asked for,
/// because most shapes need few of their numbers.
template <class S>
class BodyFrame {
 public:
  using V3 = lane::V3<S>;

  /// Without `with_orientation` the axes must not be used.
  MURO_INLINE BodyFrame(const lane::Places<S>& pose, bool with_orientation) : position_(lane::load_vector(pose)) {
    if (!with_orientation) return;
    S q[4];
    lane::load_rows(pose, 3, q);
    orientation_ = {q[0], q[1], q[2], q[3]};
  }

  const V3& position() const { return position_; }  ///< m, world
  const lane::Q4<S>& orientation() const { return orientation_; }
  /// Returns axis k in the world.
  MURO_INLINE V3 axis(int k) const {
    switch (k) {
      case 0:
        return orientation_.matrix().x;
      case 1:
        return orientation_.matrix().y;
      default:
        return orientation_.matrix().z;
    }
  }
  /// Rotates a vector from body axes to the world.
  MURO_INLINE V3 rotated(const double* v) const { return orientation_.matrix() * lane::splat<S>(v); }

 private:
  V3 position_;
  lane::Q4<S> orientation_;
};

}  // namespace MURO_ISA
}  // namespace muro::contact_geometry
