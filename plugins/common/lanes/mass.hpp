// SPDX-License-Identifier: MIT
// Mass of a rigid body over any scalar of muro/simd.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

/// Applies a symmetric tensor in the axes of the body (r: body to world) to a vector in the axes of the world.
template <class S>
MURO_INLINE V3<S> in_world(const M3<S>& r, const M3<S>& tensor, const V3<S>& v) {
  return r * (tensor * transposed_times(r, v));
}

/// Mass properties of a whole robot in the frame of its base.
template <class S>
struct Mass {
  V3<S> com;           ///< m
  V3<S> com_velocity;  ///< m/s, relative to the base
  M3<S> tensor;        ///< kg m^2, about the centre of mass
};

}  // namespace MURO_ISA
}  // namespace muro::lane
