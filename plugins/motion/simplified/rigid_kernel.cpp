// SPDX-License-Identifier: MIT
#include "rigid.hpp"

#include "muro/lane/rows.hpp"
#include "rigid_body.hpp"

namespace muro::simplified {
namespace {

using namespace lane;
using namespace integrator;

/// Takes on the wanted speed as fast as allowed, with constant acceleration over the step.
template <class S>
MURO_INLINE void turn_wheels(const RigidWork& work, const RigidRobot* robots) {
  constexpr int n = count_of<S>;
  for (std::uint32_t k = 0; k < work.wheels; ++k) {
    Places<S, double> position, velocity;
    Places<S> target, old_position, old_velocity;
    for (int i = 0; i < n; ++i) {
      const Wheel& w = robots[i].wheels[k];
      old_position.at[i] = position.at[i] = w.position;
      old_velocity.at[i] = velocity.at[i] = w.velocity;
      target.at[i] = w.target;
    }
    const S speed(work.limits[k].speed), change(work.limits[k].acceleration * work.dt);
    const S v = load<S>(old_velocity, 0);
    const S wanted = max(min(load<S>(target, 0), speed), -speed);
    const S u = max(min(wanted, v + change), v - change);
    store<S>(position, 0, load<S>(old_position, 0) + S(0.5) * (v + u) * S(work.dt));
    store<S>(velocity, 0, u);
  }
}

template <class S>
MURO_INLINE M3<S> matrix_of(const double* columns) {
  return {splat<S>(columns), splat<S>(columns + 3), splat<S>(columns + 6)};
}

template <class S>
MURO_INLINE unsigned move(const RigidWork& work, const RigidRobot* robots) {
  constexpr int n = count_of<S>;
  turn_wheels<S>(work, robots);
  Places<S> from_pose, from_twist, wrench;
  Places<S, double> to_pose, to_twist;
  for (int i = 0; i < n; ++i) {
    from_pose.at[i] = to_pose.at[i] = robots[i].pose;
    from_twist.at[i] = to_twist.at[i] = robots[i].twist;
    wrench.at[i] = robots[i].wrench;
  }
  S p[7], t[6], w[6];
  load_rows(from_pose, 0, p);
  load_rows(from_twist, 0, t);
  load_rows(wrench, 0, w);
  PoseOf<S> pose{{p[0], p[1], p[2]}, {p[3], p[4], p[5], p[6]}};
  TwistOf<S> twist{{t[0], t[1], t[2]}, {t[3], t[4], t[5]}};
  const RigidModel& model = *work.model;
  const V3<S> none{S(0), S(0), S(0)};
  const Mass<S> mass{splat<S>(model.com), none, matrix_of<S>(model.inertia)};
  const M3<S> inverse = matrix_of<S>(model.inverse);
  move_base<false>(pose, twist, V3<S>{w[0], w[1], w[2]}, V3<S>{w[3], w[4], w[5]}, mass, mass, inverse, inverse,
                   S(model.inverse_mass), splat<S>(work.gravity), work.dt);
  const V3<S>&x = pose.position, &v = twist.linear, &a = twist.angular;
  const Q4<S>& q = pose.orientation;
  constexpr unsigned all = (1u << n) - 1;
  store_rows(to_pose, 0, {x.x, x.y, x.z, q.x, q.y, q.z, q.w}, all);
  store_rows(to_twist, 0, {v.x, v.y, v.z, a.x, a.y, a.z}, all);
  const S sum = x.x + x.y + x.z + v.x + v.y + v.z + a.x + a.y + a.z;
  return bits(!(sum - sum == S(0)));
}

unsigned move_one(const RigidWork& work, const RigidRobot* robot) { return move<double>(work, robot); }
unsigned move_eight(const RigidWork& work, const RigidRobot* robots) { return move<Double8>(work, robots); }

}  // namespace

namespace MURO_ISA {
extern const RigidKernels rigid_kernels;
const RigidKernels rigid_kernels{&move_one, &move_eight};
}  // namespace MURO_ISA

}  // namespace muro::simplified
