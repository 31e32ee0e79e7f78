// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "muro/simd/lane.hpp"

namespace muro::native {

/// Where the poses of a robot's bodies lie. Those of bases lie in one part of memory and those of links in another, in
/// each part mostly in equal distances from robot to robot.
struct Poses {
  const double* base = nullptr;
  const double* links = nullptr;  ///< of one of the links
};

/// Where one of them lies, for all robots of a team.
struct Spot {
  bool of_base = true;
  std::ptrdiff_t behind = 0;  ///< numbers, of a link's pose behind Poses::links

  MURO_INLINE const double* in(const Poses& poses) const { return of_base ? poses.base : poses.links + behind; }
  friend bool operator==(const Spot&, const Spot&) = default;
};

}  // namespace muro::native
