// SPDX-License-Identifier: MIT
// Places where friction acts in faces that touch: see pressure_cells.hpp.
#pragma once

#include <algorithm>

#include "batch.hpp"
#include "plugins/common/contact_geometry/pressure_cells.hpp"
#include "spatial.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using contact_geometry::same_direction;

/// Finds the cell of each contact of one robot, some of which are in faces.
inline void find_faces(KernelContact* contacts, int count) {
  for (int begin = 0, end = 0; begin < count; begin = end) {
    KernelContact* const first = contacts + begin;
    const V3<double> normal = lane::splat<double>(first->place + 3);
    const auto belongs = [&](const KernelContact& c) {
      return c.traits & KernelContact::joins && dot(normal, lane::splat<double>(c.place + 3)) > same_direction;
    };
    for (end = begin + 1; end < count && belongs(contacts[end]);) ++end;
    if (first->partner) continue;
    first->set(KernelContact::has_cell, end > begin + 1);
    if (end == begin + 1) {
      std::fill_n(first->extent->shift, 3, 0.0);
      continue;
    }
    contact_geometry::find_shifts(
        end - begin, first->traits & KernelContact::is_of_disc ? 1 : 0,
        [&](int i) { return lane::splat<double>(first[i].place); },
        [&](int i, const V3<double>& shift) {
          double* const to = first[i].extent->shift;
          to[0] = shift.x, to[1] = shift.y, to[2] = shift.z;
          first[i].set(KernelContact::has_cell, true);
        });
  }
}

/// A face of each robot of a pack. The faces have the same number of points, and those of a face lie in one plane.
template <class S>
class Face {
 public:
  static constexpr int most_points = 8;

  /// Finds the shifts. `first`: first contact of the face of each robot. Returns false if this is no such face.
  bool find(KernelContact* const (&first)[lane::count_of<S>]) {
    const int count = first[0]->face;
    if (count > most_points) return false;
    V3<S> points[most_points], normal;
    S is_disc(0);
    for (int k = 0; k < count; ++k) {
      lane::Places<S> places;
      for (int i = 0; i < lane::count_of<S>; ++i) places.at[i] = first[i][k].place;
      S row[6];
      lane::load_rows(places, 0, row);
      points[k] = {row[0], row[1], row[2]};
      const V3<S> own{row[3], row[4], row[5]};
      if (k == 0) normal = own;
      if (lane::any(!(dot(normal, own) > S(same_direction)))) return false;
    }
    for (int i = 0; i < lane::count_of<S>; ++i)
      if (first[i]->traits & KernelContact::is_of_disc) {
        if constexpr (lane::count_of<S> == 1)
          is_disc = 1;
        else
          is_disc.set(i, 1);
      }
    contact_geometry::find_shifts<S>(
        count, is_disc, [&](int i) { return points[i]; }, [&](int i, const V3<S>& shift) { shifts_[i] = shift; });
    next_ = 0, count_ = count;
    return true;
  }
  /// Returns the shift (m, world) from the next point to where its friction acts; null when there is none.
  const V3<S>* next() { return next_ < count_ ? &shifts_[next_++] : nullptr; }

 private:
  V3<S> shifts_[most_points];
  int next_ = 0, count_ = 0;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
