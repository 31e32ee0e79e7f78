// SPDX-License-Identifier: MIT
// Points of contact of several robots with the scenery, and the patches that they form; in SIMD lanes of robots.
#pragma once

#include "contact_lanes.hpp"

namespace muro::penalty::law {
namespace {

using lane::all_lanes, lane::any, lane::bits, lane::mask_of, lane::MaskOf;

template <class S>
struct ContactPoint {
  V3<S> at, normal;
  S depth, friction;
  S patch;  ///< number; -1 in lanes of robots that have fewer contacts
};

/// A patch of each robot.
template <class S>
struct PatchLanes {
  V3<S> normal;
  S object;  ///< -1 in lanes of robots that have fewer patches
  EffectiveMass<S> mass;

  /// Returns the lanes in which a contact belongs to the patch.
  MURO_INLINE MaskOf<S> has(const V3<S>& its_normal, S its_object) const {
    return (dot(normal, its_normal) > S(same_direction)) & (object == its_object);
  }
};

/// The points and patches of all contacts of the robots.
template <class S>
struct ContactPoints {
  int patch_count = 0;  ///< of the robot that has most
  PatchLanes<S> patches[max_contacts];
  ContactPoint<S> points[max_contacts];

  /// Reads all contacts and assigns them to patches. Returns the number of patches of each robot.
  MURO_INLINE S load(const ContactLanes<S>& lanes) {
    S of_patches(1);
    for (int k = 0; k < lanes.most; ++k) {
      S c[contact_numbers];
      lanes.load_contact(k, c);
      ContactPoint<S>& p = points[k];
      p.at = {c[0], c[1], c[2]}, p.normal = {c[3], c[4], c[5]};
      p.depth = c[6], p.friction = c[7];
      const S object =
          lanes.has_many_objects ? lanes.of_contacts(k, [](const KernelContact& x) { return x.object; }) : S(0);
      if (k == 0) {
        patches[0].normal = p.normal, patches[0].object = object;
        patch_count = 1;
      }
      S found(0);
      if (const auto fits = patches[0].has(p.normal, object);
          k > 0 && (patch_count > 1 || bits(fits) != all_lanes<S>)) {
        found = select(fits, S(0), S(-1));
        for (int n = 1; n < patch_count; ++n) found = select(patches[n].has(p.normal, object), S(n), found);
        if (const auto fresh = (found < S(0)) & (S(k) < lanes.count); any(fresh)) {
          found = select(fresh, of_patches, found);
          add_patches(fresh, of_patches, p.normal, object);
          of_patches += select(fresh, S(1), S(0));
        }
      }
      p.patch = k < lanes.least ? found : select(S(k) < lanes.count, found, S(-1));
    }
    return of_patches;
  }
  /// Adds patch `number` in each of the lanes. The contact is its first.
  MURO_INLINE void add_patches(MaskOf<S> lanes, S number, const V3<S>& normal, S object) {
    if (any(lanes & (number == S(patch_count)))) patches[patch_count++] = {normal, S(-1), {}};
    for (int n = 1; n < patch_count; ++n) {
      const auto here = lanes & (number == S(n));
      patches[n].normal = select(here, normal, patches[n].normal);
      patches[n].object = select(here, object, patches[n].object);
    }
  }

  /// Returns the lanes in which contacts k - 1 and k belong to one group and one patch.
  MURO_INLINE MaskOf<S> joined(const ContactLanes<S>& lanes, int k) const {
    MaskOf<S> both = points[k].patch == points[k - 1].patch;
    if (k >= lanes.least) both = both & (S(k) < lanes.count);
    if (lanes.groups >> k & 1) {
      unsigned go_on = 0;
      for (int i = 0; i < count_of<S>; ++i) go_on |= (~lanes.robot(i).groups >> k & 1) << i;
      both = both & mask_of<S>(go_on);
    }
    return both;
  }
  /// Returns the normal of the patch of contact k: that of its first contact.
  MURO_INLINE V3<S> patch_normal(int k) const {
    V3<S> normal = patches[0].normal;
    for (int n = 1; n < patch_count; ++n) normal = select(points[k].patch == S(n), patches[n].normal, normal);
    return normal;
  }
  /// Finds the effective mass of contact k. If it were returned, gcc would copy it in pieces, and reads would wait.
  MURO_INLINE void find_mass(int k, EffectiveMass<S>& mass) const {
    mass = patches[0].mass;
    for (int n = 1; n < patch_count; ++n) {
      const auto here = points[k].patch == S(n);
      const EffectiveMass<S>& other = patches[n].mass;
      mass.along = select(here, other.along, mass.along);
      mass.across = select(here, other.across, mass.across);
      mass.inverse_across = select(here, other.inverse_across, mass.inverse_across);
    }
  }

  /// Divides the effective mass of each patch among its points. Returns the stiffness that holds the robot.
  MURO_INLINE SpringStiffness<S> find_effective_masses(const ContactLanes<S>& lanes, const Mobility<S>& body) {
    SpringStiffness<S> all;
    const bool plain = patch_count == 1;
    for (int n = 0; n < patch_count; ++n) {
      Patch<S> patch(patches[n].normal, body.centre);
      for (int k = n; k < lanes.most; ++k) {
        if (plain && k < lanes.least)
          patch.add(points[k].at);
        else if (const auto here = points[k].patch == S(n); any(here))
          patch.add_where(here, points[k].at);
      }
      EffectiveMass<S>& mass = patches[n].mass;
      mass = EffectiveMass<S>(patch.at_middle(body), patch.count);
      const SpringStiffness<S> springs = patch.stiffness(mass.along, mass.across);
      all += plain ? springs : springs.where(patch.count > S(0));
    }
    return all;
  }
};

}  // namespace
}  // namespace muro::penalty::law
