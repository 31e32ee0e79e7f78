// SPDX-License-Identifier: MIT
#pragma once

#include "muro/simd/rows.hpp"
#include "spot.hpp"

namespace muro::native {

/// As muro::ShapeKind, which kernels do not see.
enum class Form : std::uint32_t { box, sphere, cylinder, capsule, plane, mesh };

/// A shape in its body, as plain numbers.
struct Solid {
  Form form = Form::box;
  std::uint32_t body = 0;  ///< which of a robot's bodies, from 0
  Spot pose;               ///< of that body
  /// m. box: half lengths. sphere: the radius three times. cylinder, capsule: radius, radius, half the
  /// length along z (of a capsule: of its straight part). plane: unused.
  double half[3] = {};
  double centre[3] = {};  ///< m, in the body
  double axes[9] = {};    ///< of the shape in the body, column by column
  /// What makes `centre` and `axes` simple. Axis k of the shape is axis |along[k]| - 1 of the body, opposite when
  /// negative; 0: slanted.
  int along[3] = {};
  bool centred = false;  ///< `centre` is 0

  /// Whether it matters how the body is turned.
  MURO_INLINE bool turns() const { return form != Form::sphere || !centred; }

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
using lane::abs, lane::any, lane::as_read, lane::bits, lane::count_of, lane::load, lane::MaskOf, lane::max, lane::min,
    lane::Places, lane::select, lane::sqrt, lane::V3;

/// A body at its place. Axes are worked out where they are asked for: most shapes need few of their numbers.
template <class S>
class Body {
 public:
  /// Without `turns` nobody asks how it is turned.
  MURO_INLINE Body(const Places<S>& pose, bool turns) : position_(lane::load_vector(pose)) {
    if (!turns) return;
    S q[4];
    lane::load_rows(pose, 3, q);
    orientation_ = {q[0], q[1], q[2], q[3]};
  }

  const V3<S>& position() const { return position_; }  ///< m, world
  /// Axis k in the world.
  MURO_INLINE V3<S> axis(int k) const {
    switch (k) {
      case 0:
        return orientation_.matrix().x;
      case 1:
        return orientation_.matrix().y;
      default:
        return orientation_.matrix().z;
    }
  }
  /// Body axes to world.
  MURO_INLINE V3<S> turned(const double* v) const { return orientation_.matrix() * lane::splat<S>(v); }

 private:
  V3<S> position_;
  lane::Q4<S> orientation_;
};

/// A shape whose body is at its place.
template <class S>
class Standing {
 public:
  Standing(const Solid& solid, const Body<S>& body) : solid_(solid), body_(body) {}

  Form form() const { return solid_.form; }
  const double* half() const { return solid_.half; }
  /// m, world.
  MURO_INLINE V3<S> centre() const {
    return solid_.centred ? body_.position() : body_.position() + body_.turned(solid_.centre);
  }
  /// Axis k of the shape, in the world.
  MURO_INLINE V3<S> axis(int k) const {
    const int along = solid_.along[k];
    if (along == 0) return body_.turned(solid_.axes + 3 * k);
    return along > 0 ? body_.axis(along - 1) : -body_.axis(-along - 1);
  }

 private:
  const Solid& solid_;
  const Body<S>& body_;
};

}  // namespace MURO_ISA
}  // namespace lanes
}  // namespace muro::native
