// SPDX-License-Identifier: MIT
#pragma once

#include "muro/simd/rows.hpp"
#include "plugins/common/contact_geometry/body_frame.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Clearance kept from an earlier step: how far a shape could move without touching from where its body was then.
/// Results do not depend on it. Each lane has its own numbers (numbers_of_clearance): position and orientation of the
/// body, and half of the square of that distance.
template <class S>
class KeptClearance {
 public:
  /// `reach` (m): farthest distance of the shape from the origin of its body.
  MURO_INLINE KeptClearance(const lane::Places<S, double>& kept, const contact_geometry::BodyFrame<S>& body,
                            double reach)
      : kept_(kept) {
    const lane::V3<S>& p = body.position();
    const lane::Q4<S>& q = body.orientation();
    const S now[7] = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
    S before[8];
    lane::load_rows(lane::as_read(kept), 0, before);
    S way2(0), turn2(0);
    for (int k = 0; k < 7; ++k) {
      now_[k] = now[k];
      const S d = now[k] - before[k];
      (k < 3 ? way2 : turn2) += d * d;
    }
    // a turn between unit quaternions moves a point by at most 2 * (their distance) * (its distance from the origin)
    still_clear_ = way2 + S(4 * reach * reach) * turn2 < before[7];
  }

  lane::MaskOf<S> still_clear() const { return still_clear_; }
  /// Keeps `far` (m) as the clearance from now on. `which`: bits of the lanes concerned.
  MURO_INLINE void keep(S far, unsigned which) const {
    const S far_or_none = lane::select(far > S(0), far, S(0));
    lane::store_rows(
        kept_, 0,
        {now_[0], now_[1], now_[2], now_[3], now_[4], now_[5], now_[6], S(0.49) * (far_or_none * far_or_none)}, which);
  }

 private:
  const lane::Places<S, double>& kept_;
  S now_[7];
  lane::MaskOf<S> still_clear_;
};

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
