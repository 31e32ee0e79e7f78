// SPDX-License-Identifier: MIT
// Contacts of one group and their friction anchors, over SIMD lanes of robots.
#pragma once

#include "contact_lanes.hpp"
#include "old_anchors.hpp"

namespace muro::penalty::law {
namespace {

using lane::load_twist, lane::load_vector, lane::MaskOf, lane::TwistOf;

/// Contacts `begin` to `end` - 1, of one group in each robot, and their friction anchors of the step before.
template <class S>
struct ContactRun {
  int begin, end;
  int most_anchors;
  Places<S> poses, twists, anchors;
  int last_anchor[count_of<S>];  ///< -1: none
  bool all_have_anchors;

  MURO_INLINE void find_end_and_bodies(const ContactLanes<S>& lanes) {
    end = begin + 1;
    while (lanes.is_joined(end)) ++end;
    if (lanes.one_pattern && begin < lanes.least) {
      const KernelContact& c = lanes.contacts[0][begin];
      for (int i = 0; i < count_of<S>; ++i)
        poses.at[i] = lanes.poses.at[i] + c.pose, twists.at[i] = lanes.twists.at[i] + c.twist;
    } else {
      lanes.each_contact(begin, [&](int i, const KernelContact& c) {
        poses.at[i] = lanes.poses.at[i] + c.pose, twists.at[i] = lanes.twists.at[i] + c.twist;
      });
    }
  }
  MURO_INLINE void find_anchors(const ContactLanes<S>& lanes) {
    most_anchors = end - begin;
    all_have_anchors = true;
    if (lanes.is_uniform) return;
    most_anchors = 0;
    lanes.each_contact(begin, [&](int i, const KernelContact& c) {
      const int count = c.anchors_end - c.anchors_begin;
      // if there is none, numbers of the contact are read instead
      anchors.at[i] = count > 0 ? lanes.before.at[i] + c.anchors_begin * anchor_stride
                                : lanes.listed.at[i] + c.place * contact_stride;
      last_anchor[i] = count - 1;
      all_have_anchors = all_have_anchors && count > 0;
      most_anchors = count > most_anchors ? count : most_anchors;
    });
  }
  MURO_INLINE MaskOf<S> have_anchors() const {
    if (all_have_anchors) return S(1) > S(0);
    double last[count_of<S>];
    for (int i = 0; i < count_of<S>; ++i) last[i] = last_anchor[i];
    return ContactLanes<S>::side_by_side(last) >= S(0);
  }
  template <int n>
  MURO_INLINE void load_anchors(const ContactLanes<S>& lanes, OldAnchors<S, n>& to) const {
    const int count = n < max_contacts ? n : most_anchors;
    if (lanes.is_uniform) {
      for (int k = 0; k < count; ++k) to.load(k, lanes.before, (begin + k) * anchor_stride);
    } else {
      Places<S> at = anchors;
      for (int k = 0; k < count; ++k) {
        to.load(k, at, 0);
        for (int i = 0; i < count_of<S>; ++i) at.at[i] += k < last_anchor[i] ? anchor_stride : 0;  // repeats the last
      }
    }
    if (lanes.rolling != 0) load_ways(lanes, count, to);
  }
  /// Loads the ways of anchors. Ways of robots that do not roll are any numbers.
  template <int n>
  [[gnu::noinline]] void load_ways(const ContactLanes<S>& lanes, int count, OldAnchors<S, n>& to) const {
    Places<S> at = lanes.ways_before;
    lanes.each_contact(begin, [&](int i, const KernelContact& c) {
      if (lanes.robot(i).rolls && c.anchors_end > c.anchors_begin) at.at[i] += c.anchors_begin * way_stride;
    });
    for (int k = 0; k < count; ++k) {
      to.load_way(k, at, 0);
      for (int i = 0; i < count_of<S>; ++i)
        at.at[i] += lanes.robot(i).rolls && (lanes.is_uniform || k < last_anchor[i]) ? way_stride : 0;
    }
  }
};

}  // namespace
}  // namespace muro::penalty::law
