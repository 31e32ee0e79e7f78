// SPDX-License-Identifier: MIT
// A kick from the stand: the centre of mass goes over one foot, the other one is taken back and goes forward fast,
// through the place where a ball lies before it, and comes back to where it was; then the weight is on both again.
//
// The way of the centre of mass is a polynomial, slow enough that the ZMP stays below the feet, and while one foot
// carries the centre of mass rests above it: trunk and leg move against each other.
#pragma once

#include "reference.hpp"

namespace walking {

struct KickSettings {
  double shift = 0.5;        ///< s, in which the weight goes over one foot, and back
  double swing = 0.4;        ///< s, in which the foot is taken back; and in which it is put down
  double back = 0.075;       ///< m, by which it is taken back
  double forward = 0.143;    ///< m, ahead of where it stood, at the end of its way forward
  double rise = 0.057;       ///< m, of the sole
  double outward = -0.008;   ///< m, from the centre of the sole that carries: where the centre of mass goes
  double com_height = 0.25;  ///< m, above the soles
};

class Kick {
 public:
  static constexpr double slowest = 0.05;  ///< m/s

  /// From where the robot stands on both feet, with this foot; `speed`, m/s, is the largest of the sole on its way
  /// forward.
  void begin(const Reference& from, Side foot, double speed, const KickSettings& k);
  void advance(double h) { time_ += h; }

  bool has_begun() const { return begun_ != 0; }
  bool is_done(const KickSettings& k) const { return begun_ && time_ >= shift_back_at(k) + k.shift; }
  void clear() { *this = {}; }
  Reference reference(const KickSettings& k) const;

 private:
  /// s, since the kick has begun: when one of its parts begins.
  double forward_at(const KickSettings& k) const { return k.shift + k.swing; }
  double return_at(const KickSettings& k) const { return forward_at(k) + forward_; }
  double shift_back_at(const KickSettings& k) const { return return_at(k) + k.swing; }
  void place_com(Reference& now, const KickSettings& k) const;
  SolePlace swing_sole(const KickSettings& k) const;

  Reference from_;
  double time_ = 0;     // s
  double forward_ = 0;  // s, of the way forward
  Side foot_ = left_side;
  std::int64_t begun_ = 0;
};

}  // namespace walking
