// SPDX-License-Identifier: MIT
// Motion and force of a contact, over SIMD lanes of robots.
#pragma once

#include "contact_points.hpp"

namespace muro::penalty::law {
namespace {

using lane::TwistOf;

template <class S>
struct ContactMotion {
  S approach;          ///< m/s
  V3<S> slip;          ///< m/s, of the middle of its cell
  S spin;              ///< m/s: of the ends of its cell, see law::speed_of_ends
  V3<S> displacement;  ///< m, tangential

  /// Finds the slip of the point, not of the middle of its cell. `body`: motion of its body; `origin`: of the body.
  MURO_INLINE void find_slip(const ContactPoint<S>& p, const TwistOf<S>& body, const V3<S>& origin) {
    const V3<S> velocity = body.linear + cross(body.angular, p.at - origin);
    approach = -dot(velocity, p.normal);
    slip = velocity + approach * p.normal;
  }
  /// Finds the tangential displacement. `old`: in the step before; `elapsed`: s since then.
  MURO_INLINE void find_displacement(const V3<S>& normal, const V3<S>& old, S elapsed) {
    const V3<S> all = old + slip * elapsed;
    displacement = all - normal * dot(normal, all);
  }
};

/// Force of a contact: along the normal in its point, across it in the middle of its cell.
template <class S>
struct ContactForce {
  V3<S> along, across;
};

}  // namespace
}  // namespace muro::penalty::law
