// SPDX-License-Identifier: MIT
// Finds out whether servos give way under the weight as `stiffness` says, by how far joints are behind their targets.
// Only joints on springs need a lead, and feedback by ankles; it makes joints that meet their targets oscillate. A
// motion may be replaced during a walk, from one by forces to one by kinematics and back.
#pragma once

#include <cstdint>

#include "body.hpp"
#include "reference.hpp"

namespace walking {

class Springs {
 public:
  /// Returns 1 when joints are on springs; 0 when they meet their targets, whatever they carry.
  double share() const { return share_; }

  /// Takes readings of a robot that stands at rest and will stay there for a while. `sag`: by how much springs would
  /// give way; `behind`: by how much joints are behind their targets, rad. Called every `h` s.
  void feel_at_rest(const BothLegs& sag, const BothLegs& behind, double h);
  /// Takes readings of a robot that stands, walks or kicks as `now` says. Only the legs that carry count.
  void feel(const BothLegs& sag, const BothLegs& behind, const Reference& now, double h);
  /// Assumes springs again. The robot has fallen, and legs that carry nothing meet their targets.
  void forget() { *this = {}; }

 private:
  double share_ = 1;
  double given_ = 1;            ///< share of `sag` by which joints are behind, smoothed
  double met_ = 0;              ///< s, for which joints have met their targets
  std::int64_t gives_way_ = 1;  ///< value that `share_` goes to; no bool: padding would be saved
};

}  // namespace walking
