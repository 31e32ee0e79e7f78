// SPDX-License-Identifier: MIT
// The path of a body after an impact within the last step.
#pragma once

#include "muro/simd/rows.hpp"
#include "muro/vocabulary/contact.hpp"
#include "plugins/common/lanes/mass.hpp"
#include "plugins/common/lanes/rotation.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro::contact_geometry {

/// Moves a body to where it would be if its last impulses had acted at the time of impact. Keeps the angular momentum
/// about any point: what the path adds to that of the centre is subtracted from the spin. `pose`, `twist`: numbers of
/// the base.
inline void correct_path(double* pose, double* twist, const lane::Mass<double>& mass, const lane::M3<double>& inverse,
                         double inverse_mass, const ImpactCorrection& impact) {
  using lane::cross, lane::in_world;
  lane::Places<double, double> pose_at{{pose}}, twist_at{{twist}};
  lane::PoseOf<double> p = lane::load_pose(lane::as_read(pose_at));
  lane::TwistOf<double> t = lane::load_twist(lane::as_read(twist_at));
  const lane::M3<double> start = p.orientation.matrix();
  const lane::V3<double> arm = start * mass.com, path = plain(impact.path);
  const lane::V3<double> velocity = t.linear + cross(t.angular, arm) + start * mass.com_velocity;
  const lane::V3<double> momentum =
      in_world(start, mass.tensor, t.angular) + plain(impact.carried) - cross(path, velocity);
  const lane::V3<double> turn = in_world(start, inverse, plain(impact.turn));
  p.orientation = lane::turned(lane::rotation_by(turn), p.orientation);
  const lane::M3<double> end = p.orientation.matrix();
  const lane::V3<double> new_arm = end * mass.com;
  p.position += path * inverse_mass - (new_arm - arm);
  t.angular = in_world(end, inverse, momentum);
  t.linear = velocity - cross(t.angular, new_arm) - end * mass.com_velocity;
  lane::store_pose(pose_at, 0, p);
  lane::store_twist(twist_at, 0, t);
}

}  // namespace muro::contact_geometry
