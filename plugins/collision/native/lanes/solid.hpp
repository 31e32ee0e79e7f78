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

/// A shape whose body is at `body`.
template <class S>
class Standing {
 public:
  Standing(const Solid& solid, const Turned<S>& body) : solid_(solid), body_(body) {}

  const Solid& solid() const { return solid_; }
  /// m, world.
  MURO_INLINE V3<S> centre() const {
    const double* const c = solid_.centre;
    if (c[0] == 0 && c[1] == 0 && c[2] == 0) return body_.position;
    return body_.position + body_.axes * lane::splat<S>(c);
  }
  /// Axis k of the shape, in the world.
  MURO_INLINE V3<S> axis(int k) const { return body_.axes * lane::splat<S>(solid_.axes + 3 * k); }

 private:
  const Solid& solid_;
  const Turned<S>& body_;
};

}  // namespace MURO_ISA
}  // namespace lanes
}  // namespace muro::native
