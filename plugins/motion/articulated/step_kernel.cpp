// SPDX-License-Identifier: MIT
// A step of robots of one structure: joints, contacts and bodies together.
#include <optional>

#include "contacts.hpp"
#include "flight.hpp"
#include "joints.hpp"
#include "mimic_joints.hpp"
#include "rebound_energy.hpp"
#include "runge_kutta.hpp"
#include "work.hpp"

namespace muro::articulated {
namespace {

using namespace lane;
using namespace lanes;

/// m, m/s, rad/s: diverging values pass this on their way to infinity (plugins/motion/common/watch).
constexpr double beyond = 1e12;

/// State of the bases of robots.
template <class S>
struct Bases {
  Places<S, double> pose_at, twist_at;
  PoseOf<S> pose;
  TwistOf<S> twist;

  MURO_INLINE Bases(const RobotState* robots, int count) {
    for (int i = 0; i < count_of<S>; ++i) {
      const RobotState& r = robots[i < count ? i : 0];
      pose_at.at[i] = r.pose, twist_at.at[i] = r.twist;
    }
    pose = load_pose(as_read(pose_at));
    twist = load_twist(as_read(twist_at));
  }
  MURO_INLINE void store(unsigned which) const {
    const V3<S>&p = pose.position, &v = twist.linear, &w = twist.angular;
    const Q4<S>& q = pose.orientation;
    store_numbers(pose_at, 0, {p.x, p.y, p.z, q.x, q.y, q.z, q.w}, which);
    store_numbers(twist_at, 0, {v.x, v.y, v.z, w.x, w.y, w.z}, which);
  }
  /// Places the body of the base.
  MURO_INLINE void place(BodyStep<S>& base, bool is_fixed) const {
    base.axes = pose.orientation.matrix();
    base.origin = pose.position;
    const V3<S> zero{S(0), S(0), S(0)};
    base.w = is_fixed ? zero : transposed_times(base.axes, twist.angular);
    base.v = is_fixed ? zero : transposed_times(base.axes, twist.linear);
  }
  /// Whether the pose and the twist are possible.
  MURO_INLINE MaskOf<S> is_somewhere() const {
    const S far(beyond * beyond);
    const Q4<S>& q = pose.orientation;
    const S norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, place = dot(pose.position, pose.position);
    const S speed = dot(twist.linear, twist.linear), rate = dot(twist.angular, twist.angular);
    return (place < far) & (speed < far) & (rate < far) & (norm > S(0.25)) & (norm < S(4));
  }
  /// Returns the bases half a step later, but at the same position, for the robots `which`. Their velocities change as
  /// in the last step.
  MURO_INLINE Bases in_the_middle(const Places<S, double>& accelerations, double dt, MaskOf<S> which) const {
    const S half(0.5 * dt);
    const TwistOf<S> before = load_twist(as_read(accelerations));
    Bases middle = *this;
    middle.take({pose.position, turned(rotation_by(half * twist.angular), pose.orientation)},
                {twist.linear + half * before.linear, twist.angular + half * before.angular}, which);
    return middle;
  }
  /// Keeps the change since `start`, for the robots `smooth`.
  MURO_INLINE void keep_change(const Bases& start, double dt, MaskOf<S> smooth, const Places<S, double>& kept,
                               unsigned which) const {
    const S per_second(1 / dt), zero(0);
    const V3<S> v = per_second * (twist.linear - start.twist.linear),
                w = per_second * (twist.angular - start.twist.angular);
    const TwistOf<S> before = load_twist(as_read(kept));
    const V3<S> none{zero, zero, zero}, a = select(smooth, trend<S>(v, before.linear), none),
                                        alpha = select(smooth, trend<S>(w, before.angular), none);
    store_numbers(kept, 0, {a.x, a.y, a.z, alpha.x, alpha.y, alpha.z}, which);
  }
  MURO_INLINE BaseState<S> state() const { return {pose.position, twist.linear, twist.angular, pose.orientation}; }
  MURO_INLINE void take(const BaseState<S>& b) { pose = {b.position, b.orientation}, twist = {b.velocity, b.spin}; }
  /// Takes pose and twist in the robots `which`.
  MURO_INLINE void take(const PoseOf<S>& p, const TwistOf<S>& t, MaskOf<S> which) {
    pose.position = select(which, p.position, pose.position);
    twist.linear = select(which, t.linear, twist.linear);
    twist.angular = select(which, t.angular, twist.angular);
    const Q4<S>& a = p.orientation;
    Q4<S>& q = pose.orientation;
    q = {select(which, a.x, q.x), select(which, a.y, q.y), select(which, a.z, q.z), select(which, a.w, q.w)};
  }
  /// Moves the base to its pose after a change of its velocity from `before` that came earlier by `time` (s). `fall`:
  /// m/s, part of the change by forces from outside.
  MURO_INLINE void advance(S time, const TwistOf<S>& before, const V3<S>& fall) {
    pose.position += time * (twist.linear - before.linear - fall);
    pose.orientation = turned(rotation_by(time * (twist.angular - before.angular)), pose.orientation);
  }
  /// Moves the base with the mean of the velocities of both ends.
  MURO_INLINE void move(const BodyStep<S>& base, const V3<S>& gravity, double dt) {
    const S h(dt), half(0.5 * dt);
    const V3<S> acceleration = base.axes * (base.a + cross(base.w, base.v)) + gravity, turning = base.axes * base.alpha;
    pose.position += h * (twist.linear + half * acceleration);
    pose.orientation = turned(rotation_by(h * (twist.angular + half * turning)), pose.orientation);
    twist.linear += h * acceleration;
    twist.angular += h * turning;
  }
};

/// Returns the bits of robots for which `test` is true.
template <class Test>
MURO_INLINE unsigned robots_that(const RobotState* robots, int count, const Test& test) {
  unsigned bits = 0;
  for (int i = 0; i < count; ++i) bits |= test(robots[i]) ? 1u << i : 0u;
  return bits;
}
/// Returns the places of the accelerations that are kept of bases.
template <class S>
MURO_INLINE Places<S, double> accelerations_of(const RobotState* robots, int count) {
  Places<S, double> places;
  for (int i = 0; i < count_of<S>; ++i) places.at[i] = robots[i < count ? i : 0].accelerations;
  return places;
}

template <class S>
MURO_INLINE Masses<S> masses_of(const Batch& batch, const RobotState* robots, int count) {
  Masses<S> masses;
  for (int i = 0; i < count_of<S>; ++i)
    masses.at.at[i] = reinterpret_cast<const double*>(robots[i < count ? i : 0].masses);
  masses.are_equal = batch.equal_masses;
  return masses;
}

/// Whether a body turns so far in a step that the instant of its gyroscopic torque matters.
template <class S>
MURO_INLINE MaskOf<S> spins(const BodyStep<S>& body, double dt) {
  constexpr double least = 1e-4;  // rad
  return dot(body.w, body.w) > S(least * least / (dt * dt));
}

/// Stages of the trials that find the pieces of the laws of joints and contacts. Mostly the first piece is right.
/// Contacts are tried as pieces of their law, then as dampers, then as weaker dampers, and at last without friction if
/// nothing else fits.
constexpr int most_pieces = 5, most_drags = 9, most_yields = 14, most_trials = 18;
MURO_INLINE Search search_of(int trial) {
  return trial < most_pieces   ? Search::pieces
         : trial < most_drags  ? Search::drags
         : trial < most_yields ? Search::yields
                               : Search::ends;
}

template <class S>
unsigned step_some(const Batch& batch, const RobotState* robots, int count) {
  const Structure& s = batch.structure;
  const double dt = batch.dt;
  const unsigned which = first_lanes(count);
  Work<S> work(batch.work, s);
  BodyStep<S>* const bodies = work.bodies;
  Bases<S> base(robots, count);
  Joints<S> joints(batch, robots, count, work);
  const Masses<S> masses = masses_of<S>(batch, robots, count);

  // a robot that nothing touches has its accelerations in the middle of the step
  const bool steps_smoothly = s.count > 1 && !batch.runge_kutta;
  const unsigned in_flight = robots_that(robots, count, [](const RobotState& r) { return r.contact_count == 0; });
  const unsigned pushed = robots_that(robots, count, [](const RobotState& r) { return r.is_pushed; });
  const bool some_are_untouched = steps_smoothly && (in_flight & ~pushed) != 0;
  const MaskOf<S> untouched = mask_of<S>(some_are_untouched ? in_flight & ~pushed : 0);
  std::optional<Bases<S>> start;
  if (!s.fixed) start = base;
  base.place(bodies[0], s.fixed);
  MaskOf<S> flies = mask_of<S>(in_flight);
  if (s.count == 1) flies = flies | spins(bodies[0], dt);  // also on contacts
  const bool some_fly = !s.fixed && !batch.runge_kutta && (bits(flies) & which) != 0;
  if (some_fly || !some_are_untouched) place_all(s, bodies);
  std::optional<Momentum<S>> momentum;  // momentum of one body, at the start
  std::optional<Flight<S>> flight;
  if (some_fly) flight.emplace(s, masses, work);
  if (some_are_untouched) {
    joints.go_to_middle(untouched);
    if (!s.fixed) base.in_the_middle(accelerations_of<S>(robots, count), dt, untouched).place(bodies[0], false);
    place_all(s, bodies);
  }

  joints.find_laws(masses);
  Contacts<S> contacts(batch, robots, count, masses, work);
  if (s.count == 1 && !s.fixed && contacts.hits()) momentum = flight ? flight->start() : momentum_of(s, masses, bodies);
  const V3<S> gravity = splat<S>(batch.gravity), zero{S(0), S(0), S(0)};
  const V3<S> fall = s.fixed ? transposed_times(bodies[0].axes, -gravity) : zero;
  for (int trial = 1;; ++trial) {
    if (trial > 1) contacts.add_terms(), joints.set_terms();
    accelerate_all(s, masses, work, fall, S(1 / dt), trial > 1);
    std::fill_n(work.changed, s.count, false);
    if (trial == most_trials) {
      contacts.settle();
      break;
    }
    const bool loads = contacts.settle(search_of(trial)), others = joints.look_again(which);
    if (!others && !loads) break;
  }
  MaskOf<S> is_smooth = untouched;
  if (batch.runge_kutta) {
    RungeKutta<S> stages(batch, masses, joints, work);
    base.take(stages.carry(base.state()));
    joints.finish();
  } else {
    if (!s.fixed) base.move(bodies[0], gravity, dt);
    is_smooth = joints.move(untouched);
  }
  if (flight) {
    lane::PoseOf<S> pose = start->pose;
    lane::TwistOf<S> twist = start->twist;
    const bool all_are_untouched = some_are_untouched && (in_flight & pushed) == 0;
    V3<S> force = contacts.external_force(), torque = contacts.external_torque();
    if (s.count == 1) contacts.add_to(force, torque);
    flight->carry(pose, twist, untouched, all_are_untouched, gravity, force, torque, dt);
    base.take(pose, twist, flies);
  }
  if (s.count == 1 && !s.fixed && in_flight != which) {
    const S time = contacts.time_since_touch();
    if (any(time > S(0))) base.advance(time, start->twist, S(dt) * gravity);
  }
  if (momentum) {
    take_gained_energy(s, masses, bodies[0], *momentum, momentum->mass * gravity, dt, contacts.keep_energy(), base.pose,
                       base.twist);
  }
  if (!s.fixed) base.store(which);
  joints.store(which);
  if (steps_smoothly) {
    joints.keep_accelerations(is_smooth, which);
    if (!s.fixed) base.keep_change(*start, dt, is_smooth, accelerations_of<S>(robots, count), which);
  }
  const MaskOf<S> is_somewhere = base.is_somewhere(), is_finite = joints.sum() < S(beyond);
  return bits(!(is_somewhere & is_finite)) & which;
}

/// Number of robots in a pack: as many as a register holds. Wider packs would go through memory, since much is kept of
/// each robot.
constexpr int most_lanes = vectors::register_bytes / int(sizeof(double));

unsigned step(const Batch& batch, const RobotState* robots, int count) {
  using Pack = Lane<double, most_lanes>;
  unsigned broken = 0;
  for (int first = 0; first < count;) {
    const int left = count - first, used = left == 1 ? 1 : left < most_lanes ? left : most_lanes;
    unsigned of_part = 0;
    if (used == 1)
      of_part = step_some<double>(batch, robots + first, used);
    else if (used <= most_lanes / 2 && most_lanes == 8)
      of_part = step_some<Double4>(batch, robots + first, used);
    else
      of_part = step_some<Pack>(batch, robots + first, used);
    broken |= of_part << first;
    first += used;
  }
  return broken;
}

std::size_t work_bytes(int bodies, int slots, int mimics, int contacts) {
  return Work<Lane<double, most_lanes>>::bytes(bodies, slots, mimics, contacts);
}

}  // namespace

namespace MURO_ISA {
extern const Kernels kernels;
const Kernels kernels{&work_bytes, &step};
}  // namespace MURO_ISA

}  // namespace muro::articulated
