// SPDX-License-Identifier: MIT
// Contacts of several robots with the scenery, in SIMD lanes of robots: where their numbers are, how to read and write
// them.
#pragma once

#include "muro/simd/rows.hpp"
#include "plugins/contact/penalty/scenery_kernel.hpp"

namespace muro::penalty::law {
namespace {

using lane::count_of, lane::first_lanes, lane::load_rows, lane::Places, lane::store_rows;

/// The contacts of as many robots as S has values. If one has fewer than another, its last contact is repeated and
/// counts for nothing.
template <class S>
struct ContactLanes {
  const KernelRobot* const* const robots;
  const int robot_count;
  const unsigned used;                       ///< bits of lanes
  unsigned changed = 0, rolling = 0;         ///< bits of lanes, see KernelRobot
  unsigned groups = 0, common_groups = ~0u;  ///< groups of some robots and of all, see KernelRobot
  bool in_order = true, has_many_materials = false, has_many_objects = false;
  bool is_uniform = true;  ///< robots are in order, and have equal groups, which have the anchors of their contacts
  const KernelContact* contacts[count_of<S>];
  bool one_pattern = true;  ///< the contacts of all robots are the same
  Places<S> poses, twists;  ///< of the bodies of their first contacts
  int last[count_of<S>];
  int least = max_contacts, most = 0;  ///< limits of the number of contacts of a robot
  S count;                             ///< number of contacts of each robot
  Places<S> listed, before, ways_before;
  Places<S, double> anchors, ways, wrench, forces;

  /// If there are fewer robots than S has values, the first is repeated.
  MURO_INLINE ContactLanes(const KernelRobot* const* all, int count_of_all)
      : robots(all), robot_count(count_of_all), used(first_lanes(count_of_all)) {
    double counts[count_of<S>];
    for (int i = 0; i < count_of<S>; ++i) {
      const KernelRobot& r = robot(i);
      contacts[i] = r.contacts, last[i] = r.count - 1, counts[i] = r.count;
      least = r.count < least ? r.count : least;
      most = r.count > most ? r.count : most;
      groups |= r.groups, common_groups &= r.groups;
      in_order = in_order && r.in_order;
      is_uniform = is_uniform && r.groups == robots[0]->groups && r.count == robots[0]->count;
      has_many_objects = has_many_objects || r.has_many_objects;
      has_many_materials = has_many_materials || r.has_many_materials;
      changed |= unsigned(r.is_changed) << i;
      rolling |= unsigned(r.rolls) << i;
      listed.at[i] = r.listed, before.at[i] = r.before;
      anchors.at[i] = r.anchors, wrench.at[i] = r.wrench, forces.at[i] = r.forces;
      ways_before.at[i] = r.rolls ? r.ways_before : r.listed, ways.at[i] = r.ways;
      poses.at[i] = r.pose, twists.at[i] = r.twist;
      one_pattern = one_pattern && r.contacts == robots[0]->contacts;
    }
    is_uniform = is_uniform && in_order;
    count = side_by_side(counts);
  }

  const KernelRobot& robot(int lane) const { return *robots[lane < robot_count ? lane : 0]; }
  MURO_INLINE static S side_by_side(const double (&v)[count_of<S>]) {
    if constexpr (count_of<S> == 1)
      return v[0];
    else
      return lane::load_side_by_side<S>(v);
  }
  /// Returns some numbers of each robot.
  MURO_INLINE Places<S> places_of(const double* LastingContacts::*numbers) const {
    Places<S> places;
    for (int i = 0; i < count_of<S>; ++i) places.at[i] = robot(i).*numbers;
    return places;
  }
  /// Reads the numbers of MassProperties of each robot.
  MURO_INLINE void load_mass(S (&mass)[mass_numbers]) const {
    const Places<S> masses = places_of(&KernelRobot::mass);
    bool one_mass = true;
    for (int i = 1; i < count_of<S>; ++i) one_mass = one_mass && masses.at[i] == masses.at[0];
    if (one_mass)
      for (int k = 0; k < mass_numbers; ++k) mass[k] = S(masses.at[0][k]);
    else
      load_rows(masses, 0, mass);
  }

  /// Passes contact k of each robot to `sink`, with its lane.
  template <class Sink>
  MURO_INLINE void each_contact(int k, const Sink& sink) const {
    if (k < least)
      for (int i = 0; i < count_of<S>; ++i) sink(i, contacts[i][k]);
    else
      for (int i = 0; i < count_of<S>; ++i) sink(i, contacts[i][k < last[i] ? k : last[i]]);
  }
  /// Returns a number of each robot's contact k.
  template <class Number>
  MURO_INLINE S of_contacts(int k, const Number& number) const {
    if (one_pattern && k < least) return S(double(number(contacts[0][k])));
    double v[count_of<S>];
    each_contact(k, [&](int i, const KernelContact& c) { v[i] = double(number(c)); });
    return side_by_side(v);
  }
  /// Whether all robots have a contact k at place k.
  MURO_INLINE bool is_plain(int k) const { return in_order && k < least; }
  /// Whether contacts k - 1 and k are of one group in each robot. They are a line if there are only lines and points.
  MURO_INLINE bool is_joined(int k) const { return k < most && !(groups >> k & 1); }

  MURO_INLINE void load_contact(int k, S (&c)[contact_numbers]) const {
    if (is_plain(k)) return load_rows(listed, k * contact_stride, c);
    Places<S> at;
    each_contact(k, [&](int i, const KernelContact& x) { at.at[i] = listed.at[i] + x.place * contact_stride; });
    load_rows(at, 0, c);
  }
  /// Writes the friction anchor of contact k.
  MURO_INLINE void store_anchor(int k, const V3<S>& at, const V3<S>& displacement, unsigned which) const {
    const V3<S>& d = displacement;
    if (is_plain(k)) return store_rows(anchors, k * anchor_stride, {at.x, at.y, at.z, d.x, d.y, d.z}, which);
    Places<S, double> to;
    each_contact(k, [&](int i, const KernelContact& c) { to.at[i] = anchors.at[i] + c.anchor * anchor_stride; });
    store_rows(to, 0, {at.x, at.y, at.z, d.x, d.y, d.z}, which);
  }
  /// Writes the way of contact k in the last step, of robots that roll.
  [[gnu::noinline]] void store_way(int k, const V3<S>& way, unsigned which) const {
    Places<S, double> to = ways;
    each_contact(k, [&](int i, const KernelContact& c) {
      if (which >> i & 1) to.at[i] += c.anchor * way_stride;
    });
    store_rows(to, 0, {way.x, way.y, way.z}, which);
  }
};

}  // namespace
}  // namespace muro::penalty::law
