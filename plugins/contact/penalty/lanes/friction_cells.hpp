// SPDX-License-Identifier: MIT
// Cells of lines and faces in which friction acts (pressure_cells.hpp), over SIMD lanes of robots.
#pragma once

#include "contact_motion.hpp"

namespace muro::penalty::law {
namespace {

/// Cells of the robots of a call. none: points alone. lines: points and lines, the groups of all are alike, and none
/// may be in an impact. any: all others, and robots that roll.
enum class Cells { none, lines, any };

/// Returns the change of a vector that changes evenly along a line, from the first end to the middle of its cell.
template <class S>
MURO_INLINE V3<S> part_of_line(const V3<S>& first, const V3<S>& second) {
  return contact_geometry::shift_in_line(first, second);
}

/// Cells of the lines and faces of robots, and what they do to slips and friction.
template <class S>
struct FrictionCells {
  bool has_cells = false;               ///< friction of some points is in the middle of a cell
  bool has_faces = false;               ///< some of these cells are of faces; otherwise of lines alone
  bool has_line[max_contacts];          ///< contacts k and k + 1 are a line in some robots
  MaskOf<S> begins_line[max_contacts];  ///< in these robots
  MaskOf<S> in_face[max_contacts];
  V3<S> turn[max_contacts];  ///< m, in a face: slip of the middle of the cell relative to that of its point, for
                             ///< 1 rad/s about the normal

  /// Finds the cells of patches. If there is nothing but points and lines, cells of lines are not found here. `base`:
  /// m, of the robots; `may_collide`: some may be in impacts.
  MURO_INLINE Cells find(const ContactLanes<S>& lanes, const ContactPoints<S>& contacts, const V3<S>& base,
                         bool may_collide) {
    const std::uint64_t all = (std::uint64_t(1) << lanes.most) - 1, goes_on = all & ~std::uint64_t(lanes.groups);
    has_cells = (all & ~std::uint64_t(lanes.common_groups)) != 0;
    const bool is_even = contacts.patch_count == 1 && lanes.groups == lanes.common_groups && lanes.least == lanes.most;
    if (!has_cells) return lanes.rolling != 0 ? Cells::any : Cells::none;
    if (is_even && (goes_on & goes_on >> 1) == 0 && lanes.rolling == 0 && !may_collide) return Cells::lines;
    find_any(lanes, contacts, base);
    return Cells::any;
  }
  /// Finds lines and faces, if groups of the robots differ, are parts of several patches, or are faces.
  [[gnu::noinline]] void find_any(const ContactLanes<S>& lanes, const ContactPoints<S>& contacts, const V3<S>& base) {
    const int most = lanes.most;
    const MaskOf<S> no_lane = S(1) < S(0);
    MaskOf<S> goes_on[max_contacts + 2];  // the patch of contact k - 1 goes on in contact k
    goes_on[0] = goes_on[most] = goes_on[most + 1] = no_lane;
    for (int k = 1; k < most; ++k) {
      goes_on[k] = contacts.joined(lanes, k);
      has_faces = has_faces || any(goes_on[k] & goes_on[k - 1]);
    }
    for (int k = 0; k < most; ++k) {
      begins_line[k] = goes_on[k + 1] & !(goes_on[k] | goes_on[k + 2]);
      has_line[k] = any(begins_line[k]);
    }
    if (has_faces) find_faces(lanes, contacts, base, goes_on);
  }
  [[gnu::noinline]] void find_faces(const ContactLanes<S>& lanes, const ContactPoints<S>& contacts, const V3<S>& base,
                                    const MaskOf<S>* goes_on) {
    const int most = lanes.most;
    const ContactPoint<S>* const points = contacts.points;
    contact_geometry::FacePoints<S> faces[max_contacts];
    S distances[max_contacts], farthest[max_contacts];
    V3<S> arms[max_contacts];  // m, from the middle
    const auto of_face = [&](int k) -> MaskOf<S> { return (goes_on[k] | goes_on[k + 1]) & (faces[k].count > S(2)); };
    for (int k = 0; k < most; ++k) {
      turn[k] = {S(0), S(0), S(0)};
      in_face[k] = S(1) < S(0);
      faces[k] = {};
      faces[k].add(points[k].at - base);
      if (k > 0) faces[k].add_where(goes_on[k], faces[k - 1]);
    }
    for (int k = most - 2; k >= 0; --k) faces[k] = choose(goes_on[k + 1], faces[k + 1], faces[k]);
    for (int k = 0; k < most; ++k) {
      arms[k] = points[k].at - base - faces[k].middle();
      distances[k] = farthest[k] = sqrt(dot(arms[k], arms[k]));
      if (k == 0) continue;
      distances[k] += select(goes_on[k], distances[k - 1], S(0));
      farthest[k] = max(farthest[k], select(goes_on[k], farthest[k - 1], S(0)));
    }
    for (int k = most - 1; k >= 0; --k) {
      distances[k] = select(goes_on[k + 1], distances[k + 1], distances[k]);
      farthest[k] = select(goes_on[k + 1], farthest[k + 1], farthest[k]);
      const auto here = of_face(k);
      if (!any(here)) continue;
      const S is_disc = lanes.of_contacts(k, [](const KernelContact& c) { return c.is_of_disc; });
      const S share = contact_geometry::share_of_cells(faces[k], distances[k], farthest[k], is_disc);
      turn[k] = select(here, cross(contacts.patch_normal(k), arms[k]) * (share - S(1)), turn[k]);
      in_face[k] = here;
    }
  }
  template <class M>
  MURO_INLINE static contact_geometry::FacePoints<S> choose(M mask, const contact_geometry::FacePoints<S>& a,
                                                            const contact_geometry::FacePoints<S>& b) {
    return {select(mask, a.count, b.count), select(mask, a.sum, b.sum), select(mask, a.xx, b.xx),
            select(mask, a.yy, b.yy),       select(mask, a.zz, b.zz),   select(mask, a.yz, b.yz),
            select(mask, a.zx, b.zx),       select(mask, a.xy, b.xy)};
  }

  /// Moves the slip of contact k from its point to the middle of its cell, if it is in a face. Its spin is 0 otherwise.
  MURO_INLINE void move_slip_in_face(const ContactPoints<S>& contacts, int k, const V3<S>& angular,
                                     ContactMotion<S>& motion) const {
    motion.spin = S(0);
    if (!has_faces || !any(in_face[k])) return;
    const V3<S> more = dot(angular, contacts.patch_normal(k)) * turn[k];
    motion.slip = select(in_face[k], motion.slip + more, motion.slip);
    motion.spin = select(in_face[k], speed_of_ends(more), S(0));
  }
  /// Moves the slips of contacts k and k + 1 to the middles of their cells, if they are a line.
  MURO_INLINE void move_slips_of_line(int k, ContactMotion<S>* motions) const {
    if (!has_line[k]) return;
    ContactMotion<S>&first = motions[k], &second = motions[k + 1];
    const V3<S> part = part_of_line(first.slip, second.slip);
    const S spin = speed_of_ends(part);
    first.slip = select(begins_line[k], first.slip + part, first.slip);
    second.slip = select(begins_line[k], second.slip - part, second.slip);
    first.spin = select(begins_line[k], spin, first.spin);
    second.spin = select(begins_line[k], spin, second.spin);
  }
  /// Moves friction of lines from the middles of their cells to the ends, in parts, with the same effect. Friction of
  /// faces has moments about their normals.
  MURO_INLINE void move_friction(const ContactPoints<S>& contacts, int most, ContactForce<S>* forces,
                                 V3<S>& torque) const {
    if (has_faces) add_moments(contacts, most, forces, torque);
    for (int k = 0; k + 1 < most; ++k) {
      if (!has_line[k]) continue;
      V3<S>&first = forces[k].across, &second = forces[k + 1].across;
      const V3<S> part = part_of_line(first, second);
      first = select(begins_line[k], first + part, first);
      second = select(begins_line[k], second - part, second);
    }
  }
  /// Adds the moments of friction in faces.
  MURO_INLINE void add_moments(const ContactPoints<S>& contacts, int most, const ContactForce<S>* forces,
                               V3<S>& torque) const {
    for (int n = 0; n < contacts.patch_count; ++n) {
      S moment(0);
      for (int k = 0; k < most; ++k)
        if (const auto here = in_face[k] & (contacts.points[k].patch == S(n)); any(here))
          moment += select(here, dot(turn[k], forces[k].across), S(0));
      torque += moment * contacts.patches[n].normal;
    }
  }
  /// Sets the moment of friction of contact k about its point, in lanes where it is of a line or face.
  MURO_INLINE void find_moment(const ContactPoints<S>& contacts, int k, const V3<S>& across, V3<S>& moment) const {
    const ContactPoint<S>* const points = contacts.points;
    for (const int first : {k - 1, k}) {
      if (first < 0 || !has_line[first]) continue;
      const V3<S> to_cell = part_of_line(points[k].at, points[first == k ? k + 1 : k - 1].at);
      moment = select(begins_line[first], cross(to_cell, across), moment);
    }
    if (has_faces) moment = select(in_face[k], dot(turn[k], across) * contacts.patch_normal(k), moment);
  }
};

}  // namespace
}  // namespace muro::penalty::law
