// SPDX-License-Identifier: MIT
#include "joint_motion.hpp"
#include "move.hpp"
#include "muro/simd/rows.hpp"
#include "rigid_body.hpp"

namespace muro::simplified {
namespace {

using namespace lane;
using joints::JointState;

/// RobotState of as many robots as S has values. With fewer robots, the first one fills the missing places.
template <class S>
struct States {
  Places<S, double> pose, twist, positions, velocities;
  Places<S> wrench, targets;

  MURO_INLINE States(const RobotState* robots, int count) {
    for (int i = 0; i < count_of<S>; ++i) {
      const RobotState& r = robots[i < count ? i : 0];
      pose.at[i] = r.pose, twist.at[i] = r.twist, wrench.at[i] = r.wrench;
      positions.at[i] = r.positions, velocities.at[i] = r.velocities, targets.at[i] = r.targets;
    }
  }
};

/// Follows a target within limits. It is a separate function because it needs many registers and wheels do not need it.
template <class S>
[[gnu::noinline]] void follow_within_limits(Mode mode, JointState<S>& joint, const S& target, const JointRange& range,
                                            double dt) {
  if (mode == Mode::velocity)
    joints::follow_velocity(joint, target, range, dt);
  else if (mode == Mode::position)
    joints::follow_position(joint, target, range, dt);
  else
    joints::follow_acceleration(joint, target, range, dt);
}

template <class S>
MURO_INLINE void follow(const BatchParameters& batch, S& position, S& velocity, S target, const JointRange& range) {
  JointState<S> joint{position, velocity};
  if (batch.mode == Mode::velocity && !joints::is_finite(range.lower) && !joints::is_finite(range.upper)) {
    joints::follow_velocity(joint, target, JointRange{.speed = range.speed, .acceleration = range.acceleration},
                            batch.dt);
    position = joint.position, velocity = joint.velocity;
  } else {
    JointState<S> limited = joint;  // has an address; joint need not have one
    follow_within_limits<S>(batch.mode, limited, target, range, batch.dt);
    position = limited.position, velocity = limited.velocity;
  }
}

template <class S>
MURO_INLINE void move_joints(const BatchParameters& batch, const States<S>& states, unsigned which) {
  const auto move = [&]<int n>(const Joint* j, std::integral_constant<int, n>) {
    S q[n], v[n], target[n];
    load_rows(as_read(states.positions), j->position, q);
    load_rows(as_read(states.velocities), j->velocity, v);
    load_rows(states.targets, j->target, target);
    for (int i = 0; i < n; ++i) follow(batch, q[i], v[i], target[i], j[i].range);
    store_rows(states.positions, j->position, q, which);
    store_rows(states.velocities, j->velocity, v, which);
    return n;
  };
  bool leads = false;
  for (int k = 0; k < batch.joint_count;) {
    const Joint* const j = batch.joints + k;
    leads = leads || j->leader >= 0;
    if (j->leader >= 0)
      ++k;
    else
      k += j->four ? move(j, std::integral_constant<int, 4>()) : move(j, std::integral_constant<int, 1>());
  }
  for (int k = 0; leads && k < batch.joint_count; ++k) {
    const Joint& j = batch.joints[k];
    if (j.leader < 0) continue;
    const Joint& leader = batch.joints[j.leader];  // has no leader itself
    const S factor(j.multiplier);
    const S q[] = {S(j.offset) + factor * load<S>(as_read(states.positions), leader.position)};
    const S v[] = {factor * load<S>(as_read(states.velocities), leader.velocity)};
    store_rows(states.positions, j.position, q, which);
    store_rows(states.velocities, j.velocity, v, which);
  }
}

template <class S>
MURO_INLINE M3<S> matrix_of(const double* columns) {
  return {splat<S>(columns), splat<S>(columns + 3), splat<S>(columns + 6)};
}

/// Sums force and torque of all contributions, in their order.
template <class S>
MURO_INLINE TwistOf<S> wrench_of(const BatchParameters& batch, const States<S>& states, int count) {
  const V3<S> none{S(0), S(0), S(0)};
  if (batch.wrenches == 0) return {none, none};
  TwistOf<S> sum = load_twist(states.wrench);
  for (int k = 0; k < batch.wrenches - 1; ++k) {
    Places<S> at;
    for (int i = 0; i < count_of<S>; ++i)
      at.at[i] = batch.other_contributions[(i < count ? i : 0) * (batch.wrenches - 1) + k];
    const TwistOf<S> one = load_twist(at);
    sum.linear += one.linear, sum.angular += one.angular;
  }
  return sum;
}

template <class S>
unsigned move_some(const BatchParameters& batch, const RobotState* robots, int count) {
  const States<S> states(robots, count);
  const unsigned which = first_lanes(count);
  move_joints(batch, states, which);
  PoseOf<S> pose = load_pose(as_read(states.pose));
  TwistOf<S> twist = load_twist(as_read(states.twist));
  const TwistOf<S> wrench = wrench_of(batch, states, count);
  const V3<S> none{S(0), S(0), S(0)};
  const integrator::Mass<S> mass{splat<S>(batch.mass->com), none, matrix_of<S>(batch.mass->inertia)};
  const M3<S> inverse = matrix_of<S>(batch.mass->inverse);
  integrator::move_base<false>(pose, twist, wrench.linear, wrench.angular, mass, mass, inverse, inverse,
                               S(batch.mass->inverse_mass), splat<S>(batch.gravity), batch.dt);
  store_pose(states.pose, 0, pose, which);
  store_twist(states.twist, 0, twist, which);
  const V3<S> all = pose.position + twist.linear + twist.angular;
  const S sum = all.x + all.y + all.z;
  return bits(!(abs(sum) < S(JointRange::infinite))) & which;
}

void move_joints_of(const BatchParameters& batch, const RobotState* robots, int count) {
  in_lanes(count, [&]<class S>(int first, int used) {
    move_joints(batch, States<S>(robots + first, used), first_lanes(used));
    return 0u;
  });
}

unsigned move_rigid(const BatchParameters& batch, const RobotState* robots, int count) {
  return in_lanes(count, [&]<class S>(int first, int used) {
    BatchParameters rest = batch;
    if (batch.wrenches > 1) rest.other_contributions += first * (batch.wrenches - 1);
    return move_some<S>(rest, robots + first, used);
  });
}

}  // namespace

namespace MURO_ISA {
extern const Kernels kernels;
const Kernels kernels{&move_joints_of, &move_rigid};
}  // namespace MURO_ISA

}  // namespace muro::simplified
