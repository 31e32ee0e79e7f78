// SPDX-License-Identifier: MIT
// Getting up from the belly and from the back by key poses, between which joints go smoothly. A key pose says where the
// ankles are from the hips, in lengths of the leg, how soles are tilted, and where arms point, so that a robot of other
// dimensions takes the same poses by other angles.
#pragma once

#include <cstdint>
#include <span>

#include "settings.hpp"

namespace walking {

/// All angles are in the frame of the trunk, about y: 0 points down the trunk, above 0 to the back.
struct KeyPose {
  double duration;        ///< s, in which it is reached
  double ankle_distance;  ///< from hip pitch to ankle pitch, 1: of the straight leg
  double ankle_way;       ///< rad, where the ankle is from the hip
  double sole_pitch;      ///< rad, 0: parallel to that of a robot that stands, above 0 with its toes down
  double arm_pitch;       ///< rad
  double arm_spread;      ///< 0: along the trunk, 1: sideways
};

class GetUp {
 public:
  /// How far it has come.
  struct Progress {
    double time = 0;  ///< s, since the last key pose
    std::int64_t pose = 0, on_back = 0;

    void begin(bool back) { *this = {0, 0, back}; }
  };

  explicit GetUp(const Settings& settings);

  /// `h` s later.
  void advance(Progress& progress, double h) const;
  bool is_done(const Progress& progress) const { return progress.pose >= std::ssize(poses_of(progress)); }
  Posture posture(const Progress& progress) const;
  /// Legs straight, arms along the trunk: to fall in, and to begin with.
  Posture straight() const;

 private:
  static std::span<const KeyPose> poses_of(const Progress& progress);
  Posture posture_of(const KeyPose& pose) const;

  double thigh_, shin_;
};

}  // namespace walking
