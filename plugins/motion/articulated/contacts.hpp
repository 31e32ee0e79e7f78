// SPDX-License-Identifier: MIT
// The contacts and external wrenches of a pack of robots within a step.
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::as_read, lane::count_of, lane::load_rows, lane::Places, lane::store_rows;

/// What robots have that do not touch: far from everything, at rest.
inline constexpr double no_contact[7] = {0, 0, 0, 0, 0, 1, -1}, no_surface[4] = {}, nothing_kept[kept_numbers] = {},
                        at_rest[6] = {};

template <class S>
class Contacts {
 public:
  /// Finds which contacts go together. Bodies have been placed.
  Contacts(const Batch& batch, const RobotState* robots, int count, const Masses<S>& masses, Work<S>& work)
      : batch_(batch), work_(work), gravity_(splat<S>(batch.gravity)) {
    for (int k = 0; k < batch.structure.count; ++k) work.acts_on[k] = nullptr;
    set_law(robots, count);
    load_wrenches(robots, count);
    find_pushes(masses);
    load_contacts(robots, count);
  }

  MaskOf<S> is_free_of_contacts() const { return touches_ == S(0); }
  /// N, N m: the sum of what acts on bodies beside contacts, at the origin of the base.
  const V3<S>& external_force() const { return force_; }
  const V3<S>& external_torque() const { return torque_; }

  /// What contacts and wrenches add to their bodies.
  void add_terms() {
    for (int k = 0; k < batch_.structure.count; ++k)
      if (work_.acts_on[k]) work_.external[k] = wrench_on(k);
    for (int i = 0; i < work_.contact_count; ++i) {
      ContactSlot<S>& slot = work_.contacts[i];
      const BodyStep<S>& body = work_.bodies[slot.body];
      Inertia<S>& to = work_.external[slot.body];
      slot.step = touch(slot.point, law_, body.w, body.v, transposed_times(body.axes, gravity_), batch_.dt);
      lanes::add_terms(slot.point, slot.step, to);
      if (slot.resists_turning) resist(slot.point, slot.turning, law_, body.w, batch_.dt, slot.step, to);
    }
  }

  /// Whether some contact pulls, which is let go then, one that was let go would push, a sliding one would turn back, a
  /// sticking one has to hold more than it can, or a new one bears another load than was expected.
  bool look_again() {
    unsigned changed = 0;
    for (int i = 0; i < work_.contact_count; ++i) {
      ContactSlot<S>& slot = work_.contacts[i];
      const BodyStep<S>& body = work_.bodies[slot.body];
      ContactPoint<S>& p = slot.point;
      const V3<S> force = force_of(slot);
      const S load = dot(force, p.normal);
      const V3<S> across = force - load * p.normal;
      const MaskOf<S> is_on = p.is_on > S(0), is_drawn = is_on & (load < S(0));
      // friction that a load is to bear which it takes away itself
      const auto by_friction = is_drawn & (p.friction > S(0)) & (p.load > S(0));
      const auto pulls = is_drawn & !by_friction;
      const auto bears_other =
          is_on & !pulls & (p.friction > S(0)) & (p.breaks_away == S(0)) &
          (lane::abs(load - p.load) > select(slot.is_new, S(0.1), S(0.25)) * max(load, p.load) + S(0.05) * weight_);
      const V3<S> after = body.v + cross(body.w, p.arm) - p.velocity + S(batch_.dt) * acceleration_of(slot);
      const auto turns_back = dot(slot.step.slide, after) < S(0);
      // more than friction can hold, or a damper that does something else than it by now
      const S most = p.friction * max(load, S(0)), square = dot(across, across), margin(1.1 * 1.1);
      const auto breaks_away = is_on & !is_drawn & !turns_back & (p.breaks_away == S(0)) &
                               (square > margin * max(most * most, p.friction * p.friction * p.load * p.load));
      const V3<S> slip = after - dot(after, p.normal) * p.normal;
      const S speed = sqrt(dot(slip, slip)), drag = p.drag * speed;
      const auto drags_other =
          is_on & !is_drawn & (p.breaks_away > S(0)) & (lane::abs(drag - most) > S(0.1) * max(drag, most));
      p.drag = select(breaks_away | drags_other, most / max(speed, S(1e-9)), p.drag);
      p.breaks_away = select(breaks_away, S(1), p.breaks_away);
      const auto pushes_now = (!is_on) & (slot.rests > S(0)) & pushes(p, law_, dot(after, p.normal), batch_.dt);
      slot.rests = select(pushes_now, S(0), slot.rests);
      p.is_on = select(pulls, S(0), select(pushes_now, S(1), p.is_on));
      p.slides_on = select(turns_back, S(0), p.slides_on);
      const S next = likely_load(slot, load);
      slot.tried_load = p.load, slot.found_load = load;
      p.load = select(by_friction, S(0), select(bears_other, next, p.load));
      p.drag = select(by_friction, S(0), p.drag);
      changed |= lane::bits(is_drawn | pushes_now | bears_other | turns_back | breaks_away | drags_other);
    }
    return changed != 0;
  }

  /// Tells and keeps what contacts have done.
  void keep() {
    const S h(batch_.dt);
    for (int i = 0; i < work_.contact_count; ++i) {
      ContactSlot<S>& slot = work_.contacts[i];
      const BodyStep<S>& body = work_.bodies[slot.body];
      const ContactPoint<S>& p = slot.point;
      const V3<S> force = force_of(slot);
      const S load = p.is_on * max(dot(force, p.normal), S(0));
      const V3<S> own = body.v + cross(body.w, p.arm);
      const V3<S> after = own + h * acceleration_of(slot) - p.velocity;
      const V3<S> slip = after - dot(after, p.normal) * p.normal;
      const V3<S> displacement = bounded(p.displacement + h * slip, p.friction * load, law_.stiffness);
      V3<S> turn{S(0), S(0), S(0)}, moment = turn;
      if (slot.resists_turning) {
        moment = slot.step.moment(p.normal, body.alpha);
        turn = turn_after(slot, body, load);
      }
      const V3<S> d = body.axes * displacement, t = body.axes * turn;
      store_rows(slot.kept, 0,
                 {p.is_on * d.x, p.is_on * d.y, p.is_on * d.z, p.is_on * t.x, p.is_on * t.y, p.is_on * t.z,
                  select(load > S(0), load, S(unloaded))},
                 slot.which);
      tell(slot, body.axes * force, body.axes * moment);
    }
  }

 private:
  void set_law(const RobotState* robots, int count) {
    S mass(0), radius(0);
    for (int i = 0; i < count_of<S>; ++i) {
      set(mass, i, robots[i < count ? i : 0].mass);
      set(radius, i, robots[i < count ? i : 0].radius);
    }
    const S omega(batch_.omega);
    weight_ = mass * sqrt(dot(gravity_, gravity_));
    law_ = {mass * omega * omega,
            S(2) * mass * omega,
            mass,
            S(batch_.impact_speed),
            S(batch_.hard_speed),
            radius,
            S(2 * batch_.correcting_speed / batch_.omega),
            S(2) * weight_ / (mass * omega * omega)};
  }
  MURO_INLINE static void set(S& value, int i, double x) {
    if constexpr (count_of<S> == 1)
      value = x;
    else
      value.set(i, x);
  }

  void load_wrenches(const RobotState* robots, int count) {
    force_ = torque_ = {S(0), S(0), S(0)};
    bool any = false;
    for (int i = 0; i < count_of<S>; ++i) {
      const double* const of_robot = robots[i < count ? i : 0].wrenches;
      any = any || of_robot;
      wrenches_.at[i] = of_robot;
    }
    if (!any) return;
    has_wrenches_ = true;
    for (int k = 0; k < batch_.structure.count; ++k) {
      work_.acts_on[k] = work_.external + k;
      const auto [force, torque] = wrench_at(k);
      force_ += force;
      torque_ += torque + cross(work_.bodies[k].origin - work_.bodies[0].origin, force);
    }
  }
  lane::TwistOf<S> wrench_at(int body) const {
    Places<S> at;
    for (int i = 0; i < count_of<S>; ++i) at.at[i] = wrenches_.at[i] ? wrenches_.at[i] + 6 * body : at_rest;
    return lane::load_twist(at);
  }
  Inertia<S> wrench_on(int body) const {
    Inertia<S> o;
    S* const numbers = &o.A.xx;
    for (int i = 0; i < Inertia<S>::numbers; ++i) numbers[i] = S(0);
    if (!has_wrenches_) return o;
    const auto [force, torque] = wrench_at(body);
    o.f = -transposed_times(work_.bodies[body].axes, force);
    o.n = -transposed_times(work_.bodies[body].axes, torque);
    return o;
  }

  /// The next contacts of all robots that are on the body with the lowest number make up a slot.
  void load_contacts(const RobotState* robots, int count) {
    int next[count_of<S>] = {};
    touches_ = S(0);
    work_.contact_count = 0;
    for (;;) {
      int body = batch_.structure.count;
      for (int i = 0; i < count; ++i)
        if (next[i] < robots[i].contact_count && robots[i].contacts[next[i]].body < body)
          body = robots[i].contacts[next[i]].body;
      if (body == batch_.structure.count) return;
      const KernelContact* of_robot[count_of<S>] = {};
      double* wrench[count_of<S>] = {};
      for (int i = 0; i < count; ++i) {
        if (next[i] == robots[i].contact_count || robots[i].contacts[next[i]].body != body) continue;
        if (robots[i].contact_wrenches) wrench[i] = robots[i].contact_wrenches + 6 * next[i];
        of_robot[i] = robots[i].contacts + next[i]++;
        set(touches_, i, 1);
      }
      work_.acts_on[body] = work_.external + body;
      load_slot(body, of_robot, wrench, work_.contacts[work_.contact_count++]);
    }
  }

  void load_slot(int number, const KernelContact* const* of_robot, double* const* wrench, ContactSlot<S>& slot) {
    Places<S> place, surface, kept, velocity;
    slot.body = number, slot.resists_turning = false, slot.which = 0;
    bool moves = false;
    for (int i = 0; i < count_of<S>; ++i) {
      const KernelContact* const c = of_robot[i];
      place.at[i] = c ? c->place : no_contact, surface.at[i] = c ? c->surface : no_surface;
      kept.at[i] = c ? c->kept : nothing_kept, slot.kept.at[i] = c ? c->kept : nullptr;
      velocity.at[i] = c && c->other ? c->other : at_rest;
      slot.wrench[i] = wrench[i];
      slot.which |= unsigned(c != nullptr) << i;
      slot.resists_turning = slot.resists_turning || (c && c->resists_turning);
      moves = moves || (c && c->other);
    }
    const BodyStep<S>& body = work_.bodies[number];
    S at[7], of_surface[4], before[kept_numbers];
    load_rows(place, 0, at), load_rows(surface, 0, of_surface), load_rows(kept, 0, before);
    const V3<S> point{at[0], at[1], at[2]};
    ContactPoint<S>& p = slot.point;
    p.arm = transposed_times(body.axes, point - body.origin);
    p.normal = transposed_times(body.axes, V3<S>{at[3], at[4], at[5]});
    p.depth = at[6];
    p.velocity = p.spin = {S(0), S(0), S(0)};
    if (moves) {
      const lane::TwistOf<S> other = lane::load_twist(velocity);
      p.velocity = transposed_times(body.axes, other.linear);
      p.spin = transposed_times(body.axes, other.angular);
    }
    const V3<S> d = transposed_times(body.axes, V3<S>{before[0], before[1], before[2]});
    p.displacement = d - dot(d, p.normal) * p.normal;
    p.friction = of_surface[0], p.restitution = of_surface[1];
    slot.turning.rolling = of_surface[2], slot.turning.spinning = of_surface[3];
    slot.turning.displacement = transposed_times(body.axes, V3<S>{before[3], before[4], before[5]});
    const S speed = dot(body.v + cross(body.w, p.arm) - p.velocity, p.normal);
    p.pushed = knows_pushes_ ? S(batch_.dt) * dot(pushed_a_ + cross(pushed_alpha_, p.arm), p.normal) : S(0);
    // what has borne nothing in the last step is tried without
    const auto may_push = pushes(p, law_, speed, batch_.dt), bore_nothing = before[6] < S(0);
    p.is_on = select(may_push & !bore_nothing, S(1), S(0));
    slot.rests = select(bore_nothing, S(1), S(0));
    p.slides_on = S(1), p.breaks_away = p.drag = S(0);
    slot.is_new = before[6] <= S(0);
    slot.tried_load = slot.found_load = S(-1);
    p.load = select(slot.is_new, expected_load(p, law_, speed, batch_.dt), before[6]);
  }

  /// A robot that is one body: what wrenches do to it is known before contacts are.
  void find_pushes(const Masses<S>& masses) {
    knows_pushes_ = has_wrenches_ && batch_.structure.count == 1 && !batch_.structure.fixed;
    if (!knows_pushes_) return;
    const V3<S> zero{S(0), S(0), S(0)};
    const Inertia<S> wrench = wrench_on(0);
    solve(own_inertia(masses, 0, zero, zero), -wrench.n, -wrench.f, pushed_alpha_, pushed_a_);
  }

  /// N: the load that friction with this load leads to, as far as two trials tell (the secant method).
  MURO_INLINE S likely_load(const ContactSlot<S>& slot, S found) const {
    const S change = slot.point.load - slot.tried_load, slope = (found - slot.found_load) / change;
    const S meet = (found - slope * slot.point.load) / (S(1) - slope);
    const auto tells = (slot.found_load >= S(0)) & (change * change > S(0)) & (slope < S(0.5));
    return select(tells, max(meet, S(0)), found);
  }

  /// m/s^2: of the point, as accelerations of bodies say it.
  MURO_INLINE V3<S> pure_acceleration(const ContactSlot<S>& slot) const {
    const BodyStep<S>& body = work_.bodies[slot.body];
    return body.a + cross(body.alpha, slot.point.arm);
  }
  MURO_INLINE V3<S> force_of(const ContactSlot<S>& slot) const {
    return slot.step.force(slot.point.normal, pure_acceleration(slot));
  }
  /// m/s^2: change of the velocity of the point in the world, axes of the body.
  MURO_INLINE V3<S> acceleration_of(const ContactSlot<S>& slot) const {
    const BodyStep<S>& body = work_.bodies[slot.body];
    return pure_acceleration(slot) + cross(body.w, body.v) + transposed_times(body.axes, gravity_);
  }

  /// A displacement whose spring does no more than `limit`.
  MURO_INLINE static V3<S> bounded(const V3<S>& displacement, S limit, S stiffness) {
    const S most = limit / stiffness, square = dot(displacement, displacement);
    return displacement * select(square > most * most, most / sqrt(max(square, S(1e-300))), S(1));
  }
  V3<S> turn_after(const ContactSlot<S>& slot, const BodyStep<S>& body, S load) const {
    const S h(batch_.dt), stiffness = law_.stiffness * law_.radius * law_.radius;
    const V3<S>& n = slot.point.normal;
    const V3<S> turn = slot.turning.displacement + h * (body.w + h * body.alpha - slot.point.spin);
    const V3<S> wound = dot(turn, n) * n;
    return bounded(wound, slot.turning.spinning * load, stiffness) +
           bounded(turn - wound, slot.turning.rolling * load, stiffness);
  }

  static void tell(const ContactSlot<S>& slot, const V3<S>& force, const V3<S>& moment) {
    const S numbers[6] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
    for (int i = 0; i < count_of<S>; ++i) {
      if (!slot.wrench[i]) continue;
      for (int k = 0; k < 6; ++k) {
        if constexpr (count_of<S> == 1)
          slot.wrench[i][k] = numbers[k];
        else
          slot.wrench[i][k] = numbers[k][i];
      }
    }
  }

  const Batch& batch_;
  Work<S>& work_;
  V3<S> gravity_;
  ContactLaw<S> law_;
  S weight_;  ///< N, of the robot
  Places<S> wrenches_;
  bool has_wrenches_ = false;
  bool knows_pushes_ = false;
  V3<S> pushed_alpha_, pushed_a_;  ///< by wrenches alone, where pushes are known
  V3<S> force_, torque_;
  S touches_;  ///< 1: it has contacts
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
