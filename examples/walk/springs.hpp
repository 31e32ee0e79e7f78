// SPDX-License-Identifier: MIT
// Whether servos give way under the weight as `stiffness` says, found out by how far joints stay behind their targets.
// Only joints on springs ask for a lead, and for feedback by ankles: of joints that meet their targets, its gains make
// an oscillation. A motion may be exchanged during a walk, from one by forces to one by kinematics and back.
#pragma once

#include <cstdint>

#include "body.hpp"
#include "reference.hpp"

namespace walking {

class Springs {
 public:
  /// 1: joints are on springs; 0: they meet their targets, whatever they carry.
  double share() const { return share_; }

  /// The robot stands at rest, and is about to stay there for a while. `sag`: by how much springs would give way;
  /// `behind`: by how much joints are behind their targets, rad. Call it each `h` s.
  void feel_at_rest(const BothLegs& sag, const BothLegs& behind, double h);
  /// The robot stands, walks or kicks as `now` says; the legs that carry tell.
  void feel(const BothLegs& sag, const BothLegs& behind, const Reference& now, double h);
  /// The robot has fallen, and legs that carry nothing meet their targets: taken to be on springs again.
  void forget() { *this = {}; }

 private:
  double share_ = 1;
  double given_ = 1;            ///< share of `sag` by which joints are behind, smoothed
  double met_ = 0;              ///< s, since when joints have met their targets
  std::int64_t gives_way_ = 1;  ///< what `share_` goes to; no bool: bytes between would be saved
};

}  // namespace walking
