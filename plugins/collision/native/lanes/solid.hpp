// SPDX-License-Identifier: MIT
#pragma once

#include "lanes/rows.hpp"

namespace muro::native {

/// As muro::ShapeKind, which kernels do not see.
enum class Form { box, sphere, cylinder, capsule, plane, mesh };

/// A shape in its body, as plain numbers.
struct Solid {
  Form form = Form::box;
  int body = 0;  ///< which of a robot's bodies, from 0
  /// m. box: half lengths. sphere: the radius three times. cylinder, capsule: radius, radius, half the
  /// length along z (of a capsule: of its straight part). plane: unused.
  double half[3] = {};
  double centre[3] = {};  ///< m, in the body
  double axes[9] = {};    ///< of the shape in the body, column by column

  friend bool operator==(const Solid&, const Solid&) = default;
};

namespace lanes {
inline namespace MURO_ISA {

/// Where the shape is in the world when its body is at `body`.
template <class S>
MURO_INLINE Turned<S> place(const Solid& solid, const Turned<S>& body) {
  const double* const a = solid.axes;
  const M3<S> axes{lane::splat<S>(a), lane::splat<S>(a + 3), lane::splat<S>(a + 6)};
  return {body.position + body.axes * lane::splat<S>(solid.centre), body.axes * axes};
}

}  // namespace MURO_ISA
}  // namespace lanes
}  // namespace muro::native
