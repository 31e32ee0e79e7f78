// SPDX-License-Identifier: MIT
// Rolling and spinning resistance: a spring with a slider, as for friction, about the axes of a contact.
#pragma once

#include "contact_law.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// Angle by which a body has turned over another in one contact since the spring was at rest (the rolling spring of
/// Iwashita and Oda, Rolling resistance at contacts in simulation of shear band development by DEM, J. Engineering
/// Mechanics 124, 1998). It is found again in the same way as the friction anchor of the contact.
struct TurningSpring {
  std::uint64_t pair = 0;
  Vec3 point = Vec3::Zero();  ///< m, world
  Vec3 angle = Vec3::Zero();  ///< rad, world
};

/// Returns an upper bound of the largest eigenvalue (Gershgorin).
inline double largest_eigenvalue_bound(const law::Symmetric<double>& m) {
  const double xy = std::abs(m.xy), xz = std::abs(m.xz), yz = std::abs(m.yz);
  return std::max({m.xx + xy + xz, m.yy + xy + yz, m.zz + xz + yz});
}

/// Returns the torque (N m) about the contact on the body that turns with `turning` (rad/s) over the other. `spring`:
/// its angle includes the path of the last step, and is updated. `normal_force`: N. `inertia`: kg m^2, of both bodies
/// together about the axis that turns most easily, the share of this contact.
inline Vec3 turning_resistance(TurningSpring& spring, const law::FrictionLaw<double>& law, const Surface& surface,
                               const Vec3& normal, const Vec3& turning, double normal_force, double inertia) {
  Vec3 torque = Vec3::Zero(), angle = Vec3::Zero();
  const auto resist = [&](const Vec3& turned, const Vec3& rate, double coefficient) {
    if (coefficient <= 0) return;
    lane::V3<double> kept{turned.x(), turned.y(), turned.z()};
    const lane::V3<double> f = law.force(kept, {rate.x(), rate.y(), rate.z()}, coefficient * normal_force / inertia);
    torque += inertia * Vec3(f.x, f.y, f.z);
    angle += Vec3(kept.x, kept.y, kept.z);
  };
  const Vec3 spun = normal.dot(spring.angle) * normal, spin = normal.dot(turning) * normal;
  resist(spring.angle - spun, turning - spin, surface.rolling_resistance);
  resist(spun, spin, surface.spinning_resistance);
  spring.angle = angle;
  return torque;
}

}  // namespace muro::penalty

namespace muro {
MURO_OPAQUE_TYPE(penalty::TurningSpring, "muro.contact.penalty.TurningSpring", opaque);
}  // namespace muro

namespace muro::penalty {
inline constexpr Key<TurningSpring> turning_springs{"contact.turning_springs", "rad",
                                                    "list on the base of a robot: springs against rolling, spinning"};
}  // namespace muro::penalty
