// SPDX-License-Identifier: MIT
// Contacts and external wrenches of a pack of robots within a step.
#pragma once

#include <algorithm>

#include "contact_sums.hpp"
#include "contact_travel.hpp"
#include "contact_trial.hpp"
#include "faces.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using contact_geometry::load_mean_over, contact_geometry::standard_gravity;
using lane::any, lane::as_read, lane::count_of, lane::load_rows, lane::Places;

/// Contact of a robot that does not touch: far from everything, at rest.
inline constexpr double no_contact[11] = {0, 0, 0, 0, 0, 1, -1}, at_rest[6] = {};
/// Memory that is only read: a lane without a contact stores nothing.
inline double nothing_kept[kept_numbers] = {};
inline ContactExtent no_extent;
inline const KernelContact no_kernel_contact{.place = no_contact, .kept = nothing_kept, .extent = &no_extent};

template <class S>
class Contacts {
 public:
  /// Finds the contacts that go together, and the terms that they and wrenches add to their bodies. Bodies have been
  /// placed.
  Contacts(const Batch& batch, const RobotState* robots, int count, const Masses<S>& masses, Work<S>& work)
      : batch_(batch), work_(work), gravity_(splat<S>(batch.gravity)), sums_(robots, count) {
    for (int k = 0; k < batch.structure.count; ++k) work.acts_on[k] = nullptr;
    set_law(robots, count);
    load_wrenches(robots, count);
    find_pushes(masses);
    load_contacts(robots, count);
  }

  /// N, N m: sum of the wrenches on bodies that are not from contacts, at the origin of the base.
  const V3<S>& external_force() const { return force_; }
  const V3<S>& external_torque() const { return torque_; }

  /// Adds the wrench of contacts on a robot of one body, in the middle of the step.
  void add_to(V3<S>& force, V3<S>& torque) const {
    const BodyStep<S>& body = work_.bodies[0];
    for (int i = 0; i < work_.contact_count; ++i) {
      const ContactSlot<S>& slot = work_.contacts[i];
      const V3<S> f = outcome_of(slot).force;
      V3<S> t = cross(slot.point.arm, f);
      if (slot.has_cells) t += dot(slot.point.turn, f) * slot.point.normal;
      if (slot.resists_turning != 0) t += slot.step.moment(slot.point.normal, body.alpha);
      force += body.axes * f, torque += body.axes * t;
    }
  }

  /// Returns the time from first touch to the begin of the step (s), for contacts that come in; the mean is weighted by
  /// forces.
  S time_since_touch() const {
    const S zero(0);
    S sum(0), weighted(0);
    for (int i = 0; i < work_.contact_count; ++i) {
      const ContactSlot<S>& slot = work_.contacts[i];
      const MaskOf<S> counts = (slot.point.is_on > zero) & (slot.comes_in > zero);
      if (!any(counts)) continue;
      const S load = select(counts, max(dot(outcome_of(slot).force, slot.point.normal), zero), zero);
      sum += load, weighted += load * time_since_touch(slot);
    }
    return select(sum > zero, weighted / max(sum, S(1e-300)), zero);
  }

  /// Adds the terms of contacts and wrenches to their bodies, after settle() has changed what is tried.
  void add_terms() {
    for (int k = 0; k < batch_.structure.count; ++k)
      if (work_.acts_on[k] && work_.changed[k]) set_wrench(k, work_.external[k]);
    for (int i = 0; i < work_.contact_count; ++i)
      if (work_.changed[work_.contacts[i].body]) add_terms<false>(work_.contacts[i]);
  }

  /// Whether something is hit.
  bool hits() const { return any(hits_ > S(0)); }
  /// Returns the robots of which something is hit, without those that another robot pushes or that touch a body that
  /// moves on its own. These may get energy from there.
  MaskOf<S> keep_energy() const { return (hits_ > S(0)) & !((dot(force_, force_) > S(0)) | (moved_ > S(0))); }

  /// Reports and keeps the results of contacts. Returns whether the results of some do not fit what was tried, so that
  /// a further trial is needed.
  bool settle(Search search) {
    bool is_changed = false;
    sums_.start();
    for (int i = 0; i < work_.contact_count; ++i) {
      ContactSlot<S>& slot = work_.contacts[i];
      const ContactOutcome<S> outcome = outcome_of(slot);
      if (!is_changed) keep(slot, outcome);
      const Misfit<S> m = misfit(slot, outcome, law_of(slot), weight_, search);
      if (!any(m.any)) continue;
      is_changed = true;
      work_.changed[slot.body] = true;
      revise(slot, outcome, m, search);
    }
    if (!is_changed) sums_.tell();
    return is_changed;
  }
  /// Reports and keeps the results of the last trial.
  void settle() {
    sums_.start();
    for (int i = 0; i < work_.contact_count; ++i) keep(work_.contacts[i], outcome_of(work_.contacts[i]));
    sums_.tell();
  }

 private:
  void set_law(const RobotState* robots, int count) {
    S mass(0), radius(0);
    for (int i = 0; i < count_of<S>; ++i) {
      set(mass, i, robots[i < count ? i : 0].borne_mass);
      set(radius, i, robots[i < count ? i : 0].radius);
    }
    const S omega(batch_.omega);
    mean_part_ = batch_.dt < load_mean_over ? batch_.dt / load_mean_over : 1;
    weight_ = mass * sqrt(dot(gravity_, gravity_));
    const S stiffness = mass * omega * omega, damping = S(2) * mass * omega;
    law_ = {stiffness,
            damping,
            damping + S(batch_.dt) * stiffness,
            mass,
            S(batch_.impact_speed),
            S(batch_.hard_speed),
            radius,
            S(2 * batch_.correcting_speed / batch_.omega),
            S(2) * weight_ / stiffness,
            stiffness,
            S(0)};
  }
  /// Finds the load of a point. Drives may press harder than the robot weighs, so a point goes on to bear its mean
  /// load.
  MURO_INLINE void find_what_it_bears(ContactSlot<S>& slot) const {
    const S borne = slot.mean_load, own = S(standard_gravity) * law_.mass;
    slot.bears_more = any(borne > own);
    if (slot.bears_more) slot.more = min(max(borne / own, S(1)), S(contact_geometry::most_weights));
  }
  /// Forgets the mean load on bodies that move on their own. They press as hard as the contact is stiff, and would
  /// press a stiffer contact harder.
  void forget_what_squeezes(const KernelContact* const (&of_robot)[count_of<S>], ContactSlot<S>& slot) const {
    for (int i = 0; i < count_of<S>; ++i)
      if (of_robot[i]->other) set(slot.mean_load, i, 0);
  }
  MURO_INLINE const ContactLaw<S>& law_of(const ContactSlot<S>& slot) {
    return slot.bears_more ? law_of_more(slot.more) : law_;
  }
  [[gnu::noinline, gnu::cold]] const ContactLaw<S>& law_of_more(S more) {
    law_of_more_ = law_;
    law_of_more_.stiffness *= more, law_of_more_.damping *= more, law_of_more_.held *= more;
    law_of_more_.most_more = S(standard_gravity) * law_.mass * (more - S(1));
    return law_of_more_;
  }
  template <bool is_first>
  MURO_INLINE void add_terms(ContactSlot<S>& slot) {
    Inertia<S>& to = work_.external[slot.body];
    touch<is_first>(slot.point, law_of(slot), slot.velocity, work_.drifts[slot.body], slot.spins, batch_.dt, slot.step);
    lanes::add_terms(slot.point, slot.step, slot.has_cells, to);
    if (slot.resists_turning != 0) resist(slot.point, slot.turning, law_of(slot), batch_.dt, slot.step, to);
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
      set_wrench(k, work_.external[k]);
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
  /// Sets `to` to the terms of wrenches that are not from contacts.
  MURO_INLINE void set_wrench(int body, Inertia<S>& to) const {
    S* const numbers = &to.A.xx;
#pragma GCC unroll 27
    for (int i = 0; i < Inertia<S>::numbers; ++i) numbers[i] = S(0);
    if (!has_wrenches_) return;
    const auto [force, torque] = wrench_at(body);
    to.f = -transposed_times(work_.bodies[body].axes, force);
    to.n = -transposed_times(work_.bodies[body].axes, torque);
  }

  /// Loads the contacts into slots. The next contacts of all robots on the body with the lowest number make a slot.
  void load_contacts(const RobotState* robots, int count) {
    KernelContact *next[count_of<S>], *end[count_of<S>];
    double* wrench[count_of<S>];
    int body_of_next[count_of<S>];
    const int none = batch_.structure.count;
    alike_ = count == count_of<S> && robots[0].contact_bodies != 0;
    for (int i = 1; alike_ && i < count; ++i)
      alike_ =
          robots[i].contact_bodies == robots[0].contact_bodies && robots[i].contact_faces == robots[0].contact_faces;
    for (int i = 0; !alike_ && i < count; ++i)
      if (robots[i].contact_faces != 0) find_faces(robots[i].contacts, robots[i].contact_count);
    Face<S> face;
    for (int i = 0; i < count_of<S>; ++i) {
      next[i] = end[i] = nullptr, wrench[i] = nullptr;
      if (i < count) next[i] = robots[i].contacts, end[i] = next[i] + robots[i].contact_count;
      if (i < count) wrench[i] = robots[i].contact_wrenches;
      tell_each_ |= unsigned(wrench[i] != nullptr) << i;
      body_of_next[i] = next[i] == end[i] ? none : next[i]->body;
    }
    for (work_.contact_count = 0;;) {
      int body = body_of_next[0];
      for (int i = 1; !alike_ && i < count_of<S>; ++i) body = std::min(body, body_of_next[i]);
      if (body == none) return;
      const bool is_first = work_.contact_count == 0 || work_.contacts[work_.contact_count - 1].body != body;
      ContactSlot<S>& slot = work_.contacts[work_.contact_count++];
      slot.body = body, slot.which = 0;
      const KernelContact* of_robot[count_of<S>];
      if (alike_) {
        if (next[0]->face > 0 && !face.find(next))
          for (int i = 0; i < count_of<S>; ++i) find_faces(next[i], next[i]->face);
        for (int i = 0; i < count_of<S>; ++i) {
          of_robot[i] = next[i]++;
          slot.wrench.at[i] = wrench[i];
          if (wrench[i]) wrench[i] += 6;
        }
        slot.which = lane::all_lanes<S>;
        body_of_next[0] = next[0] == end[0] ? none : next[0]->body;
      } else {
        for (int i = 0; i < count_of<S>; ++i) {
          const bool has_one = body_of_next[i] == body;
          of_robot[i] = has_one ? next[i] : &no_kernel_contact;
          slot.wrench.at[i] = wrench[i];
          slot.which |= unsigned(has_one) << i;
          if (!has_one) continue;
          if (wrench[i]) wrench[i] += 6;
          body_of_next[i] = ++next[i] == end[i] ? none : next[i]->body;
        }
      }
      if (is_first) {
        const BodyStep<S>& b = work_.bodies[body];
        work_.drifts[body] = cross(b.w, b.v) + transposed_times(b.axes, gravity_);
        work_.acts_on[body] = work_.external + body;
        set_wrench(body, work_.external[body]);
      }
      load_slot(of_robot, face.next(), slot);
      add_terms<true>(slot);
    }
  }

  /// Loads a slot. `cell`: m, world, from the points to where their friction acts, in faces of alike robots; else null.
  void load_slot(const KernelContact* const (&of_robot)[count_of<S>], const V3<S>* cell, ContactSlot<S>& slot) {
    Places<S> place, kept;
    unsigned traits = 0, common = ~0u;
    for (int i = 0; i < count_of<S>; ++i) {
      const KernelContact& c = *of_robot[i];
      place.at[i] = c.place, slot.kept.at[i] = c.kept, kept.at[i] = c.kept;
      traits |= c.traits, common &= c.traits;
    }
    slot.resists_turning = 0;
    if (traits & KernelContact::resists_turning)
      for (int i = 0; i < count_of<S>; ++i)
        slot.resists_turning |= (of_robot[i]->traits & KernelContact::resists_turning ? 1u : 0u) << i;
    const bool has_rims = traits & KernelContact::has_rim, has_cells = cell || traits & KernelContact::has_cell,
               has_lines = traits & KernelContact::may_be_line,
               are_ends = alike_ && common & KernelContact::may_be_line,
               are_second = are_ends && common & KernelContact::is_second;  // these were loaded with the first
    slot.has_cells = has_cells || has_lines;
    const BodyStep<S>& body = work_.bodies[slot.body];
    const S zero(0);
    if (!are_second) {
      load_rows(place, 0, ends_[0]);
      if (are_ends) load_rows(places_of(of_robot, [](auto& c) { return c.partner; }), 0, ends_[1]);
    }
    const S *const at = ends_[are_second ? 1 : 0], *const other_end = ends_[are_second ? 0 : 1];
    S before[11];
    load_rows(kept, 0, before);
    const V3<S> point{at[0], at[1], at[2]};
    const S load = before[9];
    slot.mean_load = before[10];
    if (traits & KernelContact::is_moved) forget_what_squeezes(of_robot, slot);
    find_what_it_bears(slot);
    const ContactLaw<S>& law = law_of(slot);
    slot.lever = point - body.origin;
    const V3<S> arm = transposed_times(body.axes, slot.lever);
    ContactPoint<S>& p = slot.point;
    p.normal = transposed_times(body.axes, V3<S>{at[3], at[4], at[5]});
    const V3<S> last{before[3], before[4], before[5]};
    const MaskOf<S> is_known = (load < zero) | (load > zero);
    slot.way = select(is_known, point - V3<S>{before[0], before[1], before[2]}, {zero, zero, zero});
    lane::store_vector(slot.kept, 0, point, slot.which);
    const auto rims = [&] { return lane::load_vector(places_of(of_robot, [](auto& c) { return c.extent->rim; })); };
    const Travel<S> travel = travel_of(slot.way, last, is_known, p.normal, arm, body, has_rims, rims, batch_.dt);
    p.arm = arm + travel.half;
    p.depth = at[6];
    const V3<S> d = transposed_times(body.axes, V3<S>{before[6], before[7], before[8]});
    p.displacement = d - dot(d, p.normal) * p.normal;
    p.friction = at[7], p.restitution = at[8];
    if (slot.resists_turning != 0) {
      S of_turning[2], wound[3];
      load_rows(place, 9, of_turning), load_rows(kept, 11, wound);
      slot.turning.rolling = of_turning[0], slot.turning.spinning = of_turning[1];
      slot.turning.displacement = transposed_times(body.axes, V3<S>{wound[0], wound[1], wound[2]});
    }
    slot.velocity = body.v + cross(body.w, arm + travel.all);
    V3<S> spin = body.w;
    if (traits & KernelContact::is_moved) {
      const auto velocity = places_of(of_robot, [](auto& c) { return c.other ? c.other : at_rest; });
      const lane::TwistOf<S> other = lane::load_twist(velocity);
      slot.velocity -= transposed_times(body.axes, other.linear);
      spin -= transposed_times(body.axes, other.angular);
      moved_ += dot(other.linear, other.linear) + dot(other.angular, other.angular);
    }
    if (slot.resists_turning != 0) p.spin = spin;
    slot.spins = false;
    if (slot.has_cells) {
      slot.axis = {at[3], at[4], at[5]};
      V3<S> shift{zero, zero, zero};
      if (cell)
        shift = *cell;
      else if (has_cells)
        shift = lane::load_vector(places_of(of_robot, [](auto& c) { return c.extent->shift; }));
      if (are_ends)
        shift += shift_in_line(at, other_end);
      else if (has_lines)
        shift += shift_in_line(at, of_robot);
      p.turn = cross(p.normal, transposed_times(body.axes, shift));
      const V3<S> more = dot(spin, p.normal) * p.turn;
      slot.velocity += more;
      const S square = dot(more, more);
      slot.spins = any(square > S(least_cell_speed * least_cell_speed));
      if (slot.spins) p.cell_speed = max(sqrt(square) - S(least_cell_speed), zero);
    }
    const S speed = p.speed = dot(slot.velocity, p.normal);
    p.slip = slot.velocity - speed * p.normal;
    p.pushed = knows_pushes_ ? S(batch_.dt) * dot(pushed_a_ + cross(pushed_alpha_, p.arm), p.normal) : zero;
    // a contact that bore nothing in the last step is tried without a force
    const S push = p.push = soft_push(p, law, speed);
    const MaskOf<S> bore_nothing = load < zero, is_on = pushes(p, law, speed, push) & !bore_nothing;
    p.is_on = select(is_on, S(1), zero);
    // a contact that bears little on its way out may push on: its speed at the begin of the step does not show that
    slot.rests = select(is_on, zero, S(1));
    p.sticks = p.drags = p.drag = zero;
    slot.tried_load = slot.found_load = S(-1);
    p.load = load;
    const MaskOf<S> is_new = load <= zero, is_hit = is_impact(p, law, speed + p.pushed);
    if (any(is_new | is_hit)) p.load = select(is_new | is_hit, expected_load(p, law, speed, push, batch_.dt), load);
    slot.comes_in = select(is_new | is_hit, S(1), zero);
    p.gained = zero;
    if (!any(is_hit)) return;
    hits_ += select(is_hit, S(1), zero);
    if (batch_.structure.count == 1)
      p.gained = time_since_touch(slot) * max(-dot(work_.drifts[slot.body] - cross(body.w, body.v), p.normal), zero);
    // the impact is at the surface, before the point went in
    const V3<S> in = select(is_hit, S(-0.5) * p.depth, zero) * p.normal, turning = cross(body.w, in);
    p.arm += in, slot.velocity += turning;
    p.speed = dot(slot.velocity, p.normal), p.slip = slot.velocity - p.speed * p.normal;
  }

  /// Returns the shifts from points to the middles of their cells (m, world), for ends of lines. `at`, `other`: points
  /// and normals.
  MURO_INLINE static V3<S> shift_in_line(const S* at, const S* other) {
    const MaskOf<S> is_line =
        dot(V3<S>{at[3], at[4], at[5]}, V3<S>{other[3], other[4], other[5]}) > S(contact_geometry::same_direction);
    const V3<S> shift =
        contact_geometry::shift_in_line(V3<S>{at[0], at[1], at[2]}, V3<S>{other[0], other[1], other[2]});
    return select(is_line, shift, {S(0), S(0), S(0)});
  }
  MURO_INLINE static V3<S> shift_in_line(const S* at, const KernelContact* const (&of_robot)[count_of<S>]) {
    S other[6];
    load_rows(places_of(of_robot, [](auto& c) { return c.partner ? c.partner : c.place; }), 0, other);
    return shift_in_line(at, other);
  }
  /// Returns for each robot what `get` finds in its contact.
  template <class Get>
  MURO_INLINE static Places<S> places_of(const KernelContact* const (&of_robot)[count_of<S>], const Get& get) {
    Places<S> places;
    for (int i = 0; i < count_of<S>; ++i) places.at[i] = get(*of_robot[i]);
    return places;
  }

  /// Returns the time since first touch of a contact that comes in (s).
  MURO_INLINE S time_since_touch(const ContactSlot<S>& slot) const {
    constexpr double least = 1e-3;  // m/s
    const S approach = -dot(slot.velocity, slot.point.normal);
    return select(approach > S(least), min(slot.point.depth / max(approach, S(least)), S(batch_.dt)), S(0));
  }

  /// Finds the effect of wrenches on a robot that is one body: there it is known before that of contacts.
  void find_pushes(const Masses<S>& masses) {
    knows_pushes_ = has_wrenches_ && batch_.structure.count == 1 && !batch_.structure.fixed;
    if (!knows_pushes_) return;
    const V3<S> zero{S(0), S(0), S(0)};
    Inertia<S> wrench;
    set_wrench(0, wrench);
    solve(own_inertia(masses, 0, zero, zero), -wrench.n, -wrench.f, pushed_alpha_, pushed_a_);
  }

  MURO_INLINE ContactOutcome<S> outcome_of(const ContactSlot<S>& slot) const {
    const BodyStep<S>& body = work_.bodies[slot.body];
    const ContactPoint<S>& p = slot.point;
    V3<S> a = body.a + cross(body.alpha, p.arm);  // like the accelerations of bodies, beyond gravity
    if (slot.has_cells) a += dot(body.alpha, p.normal) * p.turn;
    ContactOutcome<S> o;
    o.force = slot.step.force(p.normal, a);
    o.load = dot(o.force, p.normal);
    o.velocity = slot.velocity + S(batch_.dt) * (a + work_.drifts[slot.body]);
    o.slip = o.velocity - dot(o.velocity, p.normal) * p.normal;
    return o;
  }

  void keep(ContactSlot<S>& slot, const ContactOutcome<S>& o) {
    const BodyStep<S>& body = work_.bodies[slot.body];
    const ContactPoint<S>& p = slot.point;
    const MaskOf<S> is_on = p.is_on > S(0);
    const S load = select(is_on, max(o.load, S(0)), S(0));
    const V3<S> none{S(0), S(0), S(0)};
    V3<S> slipped = o.slip;
    if (slot.spins)  // minus the way of the damper behind the spring
      slipped += (o.force - o.load * p.normal) * (p.cell_speed / max(p.friction * max(p.load, load), S(1e-12)));
    const V3<S> displacement =
        bounded(p.displacement + S(batch_.dt) * slipped, p.friction * load, law_of(slot).stiffness);
    const V3<S> d = body.axes * select(is_on, displacement, none);
    const V3<S>& way = slot.way;
    const S counted = select(slot.comes_in > S(0), slot.mean_load, load);  // impacts do not count as load
    const S mean = slot.mean_load + S(mean_part_) * (counted - slot.mean_load);
    store_numbers(slot.kept, 3, {way.x, way.y, way.z, d.x, d.y, d.z, select(load > S(0), load, S(unloaded)), mean},
                  slot.which);
    const V3<S> force = body.axes * o.force;
    V3<S> moment = none;
    if (slot.has_cells) moment = dot(p.turn, o.force) * slot.axis;
    if (slot.resists_turning != 0) {
      moment += body.axes * slot.step.moment(p.normal, body.alpha);
      const V3<S> t = body.axes * select(is_on, turn_after(slot, body, load), none);
      store_numbers(slot.kept, 11, {t.x, t.y, t.z}, slot.resists_turning);
    }
    if (const unsigned told = slot.which & tell_each_; told != 0)
      store_numbers(slot.wrench, 0, {force.x, force.y, force.z, moment.x, moment.y, moment.z}, told);
    sums_.add(slot.body, slot.which, force, slot.lever, moment);
  }

  /// Returns the displacement, shortened so that its spring does no more than `limit`.
  MURO_INLINE static V3<S> bounded(const V3<S>& displacement, S limit, S stiffness) {
    const S square = dot(displacement, displacement), stretch = stiffness * stiffness * square;
    const MaskOf<S> is_far = stretch > limit * limit;
    if (!any(is_far)) return displacement;
    return displacement * select(is_far, limit / (stiffness * sqrt(max(square, S(1e-300)))), S(1));
  }
  V3<S> turn_after(const ContactSlot<S>& slot, const BodyStep<S>& body, S load) {
    const S h(batch_.dt), stiffness = law_of(slot).stiffness * law_.radius * law_.radius;
    const V3<S>& n = slot.point.normal;
    const V3<S> turn = slot.turning.displacement + h * (slot.point.spin + h * body.alpha);
    const V3<S> wound = dot(turn, n) * n;
    return bounded(wound, slot.turning.spinning * load, stiffness) +
           bounded(turn - wound, slot.turning.rolling * load, stiffness);
  }

  const Batch& batch_;
  Work<S>& work_;
  V3<S> gravity_;
  ContactLaw<S> law_, law_of_more_;
  S weight_;              ///< N: weight that contacts may have to bear
  double mean_part_ = 0;  ///< share of the last step in mean loads
  Places<S> wrenches_;
  bool has_wrenches_ = false;
  bool alike_ = false;      ///< contacts of all robots are on the same bodies
  unsigned tell_each_ = 0;  ///< robots that get the wrench of each contact
  ContactSums<S> sums_;
  S ends_[2][9];  ///< place numbers of both ends of a line, of robots that are alike
  S hits_{0};     ///< above 0 for robots of which something is hit
  S moved_{0};    ///< above 0 for robots that touch something that moves
  bool knows_pushes_ = false;
  V3<S> pushed_alpha_, pushed_a_;  ///< accelerations by wrenches alone, if pushes are known
  V3<S> force_, torque_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
