// SPDX-License-Identifier: MIT
#pragma once

#include "muro/lane/rows.hpp"

namespace muro::native {

/// As muro::ShapeKind, which kernels do not see.
enum class Form : std::uint32_t { box, sphere, cylinder, capsule, plane, mesh };

/// A shape in its body, as plain numbers.
struct Solid {
  Form form = Form::box;
  std::uint32_t body = 0;  ///< which of a robot's bodies, from 0
  /// m. box: half lengths. sphere: the radius three times. cylinder, capsule: radius, radius, half the
  /// length along z (of a capsule: of its straight part). plane: unused.
  double half[3] = {};
  double centre[3] = {};  ///< m, in the body
  double axes[9] = {};    ///< of the shape in the body, column by column
  /// What makes `centre` and `axes` simple. Axis k of the shape is axis |along[k]| - 1 of the body, opposite when
  /// negative; 0: slanted.
  int along[3] = {};
  bool centred = false;  ///< `centre` is 0

  friend bool operator==(const Solid&, const Solid&) = default;
};

/// A plane at its place; the solid side is below, against the normal (unit).
struct Ground {
  double normal[3] = {0, 0, 1};
  double origin[3] = {};
  bool level = true;  ///< the normal is z
};

namespace lanes {
inline namespace MURO_ISA {

// hides ::abs and the like
using lane::abs, lane::any, lane::bits, lane::count_of, lane::MaskOf, lane::max, lane::min, lane::Places, lane::select,
    lane::sqrt, lane::V3;

/// A body at its place: position (m) and axes in the world.
template <class S>
struct Body {
  V3<S> position;
  V3<S> axes[3];

  /// Body axes to world.
  MURO_INLINE V3<S> turned(const double* v) const { return axes[0] * S(v[0]) + axes[1] * S(v[1]) + axes[2] * S(v[2]); }
};

template <class S>
MURO_INLINE Body<S> load_body(const Places<S>& pose) {
  S p[7];
  lane::load_rows(pose, 0, p);
  const lane::M3<S> m = lane::Q4<S>{p[3], p[4], p[5], p[6]}.matrix();
  return {{p[0], p[1], p[2]}, {m.x, m.y, m.z}};
}

/// A shape whose body is at its place.
template <class S>
class Standing {
 public:
  Standing(const Solid& solid, const Body<S>& body) : solid_(solid), body_(body) {}

  Form form() const { return solid_.form; }
  const double* half() const { return solid_.half; }
  /// m, world.
  MURO_INLINE V3<S> centre() const {
    return solid_.centred ? body_.position : body_.position + body_.turned(solid_.centre);
  }
  /// Axis k of the shape, in the world.
  MURO_INLINE V3<S> axis(int k) const {
    const int along = solid_.along[k];
    if (along == 0) return body_.turned(solid_.axes + 3 * k);
    return along > 0 ? body_.axes[along - 1] : -body_.axes[-along - 1];
  }

 private:
  const Solid& solid_;
  const Body<S>& body_;
};

}  // namespace MURO_ISA
}  // namespace lanes
}  // namespace muro::native
