// SPDX-License-Identifier: MIT
// Getting up from the belly and from the back by key poses, between which joints move smoothly. A key pose gives the
// place of the ankles from the hips in lengths of the leg, the tilt of the soles, and the direction of the arms. So a
// robot of other dimensions takes the same poses by other angles.
#pragma once

#include <cstdint>
#include <span>

#include "../common/two_bones.hpp"
#include "settings.hpp"

namespace walking {

/// A key pose. Angles are in the frame of the trunk, about y: 0 points down the trunk, above 0 to the back.
struct KeyPose {
  double duration;        ///< s, time to reach it
  double ankle_distance;  ///< from hip pitch to ankle pitch, in lengths of the straight leg
  double ankle_way;       ///< rad, direction from hip to ankle
  double sole_pitch;      ///< rad, 0: parallel to the sole of a standing robot, above 0 with its toes down
  double arm_pitch;       ///< rad
  double arm_spread;      ///< 0: along the trunk, 1: sideways
};

class GetUp {
 public:
  /// Progress of getting up.
  struct Progress {
    double time = 0;  ///< s, since the last key pose
    std::int64_t pose = 0, on_back = 0;

    void begin(bool back) { *this = {0, 0, back}; }
  };

  explicit GetUp(const Settings& settings);

  /// Advances by `h` s.
  void advance(Progress& progress, double h) const;
  bool is_done(const Progress& progress) const { return progress.pose >= std::ssize(poses_of(progress)); }
  Posture posture(const Progress& progress) const;
  /// Returns straight legs and arms along the trunk: the posture during a fall, and at the beginning.
  Posture straight() const;

 private:
  static std::span<const KeyPose> poses_of(const Progress& progress);
  Posture posture_of(const KeyPose& pose) const;

  examples::TwoBones bones_;  // thigh and shin
};

}  // namespace walking
