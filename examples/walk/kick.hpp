// SPDX-License-Identifier: MIT
// A kick from the stand. The centre of mass moves over one foot. The other foot is taken back, moves forward fast
// through the place of a ball in front of it, and returns to its place. Then both feet carry the weight again.
//
// The centre of mass moves by a polynomial, slowly enough that the ZMP stays below the feet. While one foot carries,
// the centre of mass rests above it: trunk and leg move against each other.
#pragma once

#include "reference.hpp"

namespace walking {

struct KickSettings {
  double shift = 0.5;        ///< s, duration of the weight shift over one foot, and back
  double swing = 0.4;        ///< s, duration of taking the foot back, and of putting it down
  double back = 0.075;       ///< m, way back
  double forward = 0.143;    ///< m, end of the way forward, ahead of its place in the stand
  double rise = 0.057;       ///< m, height of the sole
  double outward = -0.008;   ///< m, outwards from the centre of the carrying sole: place of the centre of mass
  double com_height = 0.25;  ///< m, above the soles
};

class Kick {
 public:
  static constexpr double slowest = 0.05;  ///< m/s

  /// Begins a kick with this foot, from where the robot stands on both feet. `speed`, m/s: the greatest speed of the
  /// sole on its way forward.
  void begin(const Reference& from, Side foot, double speed, const KickSettings& k);
  void advance(double h) { time_ += h; }

  bool has_begun() const { return begun_ != 0; }
  bool is_done(const KickSettings& k) const { return begun_ && time_ >= shift_back_at(k) + k.shift; }
  void clear() { *this = {}; }
  Reference reference(const KickSettings& k) const;

 private:
  /// Time at which a part of the kick begins, s since the beginning of the kick.
  double forward_at(const KickSettings& k) const { return k.shift + k.swing; }
  double return_at(const KickSettings& k) const { return forward_at(k) + forward_; }
  double shift_back_at(const KickSettings& k) const { return return_at(k) + k.swing; }
  void place_com(Reference& now, const KickSettings& k) const;
  SolePlace swing_sole(const KickSettings& k) const;

  Reference from_;
  double time_ = 0;     // s
  double forward_ = 0;  // s, duration of the way forward
  Side foot_ = left_side;
  std::int64_t begun_ = 0;
};

}  // namespace walking
