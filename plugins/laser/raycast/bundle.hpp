// SPDX-License-Identifier: MIT
// Rays as the kernels read them.
#pragma once

#include <cstdint>

namespace muro::raycast {

/// Four planes through the device around some rays: all have normal * direction >= 0. In the frame of the device; unit
/// normals, or zeros, which keep nothing out, around rays that point too far apart.
struct Frustum {
  float x[4] = {}, y[4] = {}, z[4] = {};
};

/// Rays that lie side by side, in the frame of the device.
struct alignas(64) Bundle {
  static constexpr int size = 16;
  double x[size], y[size], z[size];  ///< unit directions; places from `count` on repeat the last ray
  std::uint32_t ray[size];           ///< place of each in the reading
  std::uint32_t count = 0;
  bool in_fours = false;  ///< full, and each four of its rays, from the first on, have places one behind the other
  Frustum frustum;        ///< around them
};

/// Bundles that lie side by side: `first` to `first + count` - 1.
struct Sector {
  static constexpr std::uint32_t most = 8;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Frustum frustum;
};

}  // namespace muro::raycast
