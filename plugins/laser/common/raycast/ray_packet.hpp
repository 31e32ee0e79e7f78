// SPDX-License-Identifier: MIT
// Rays in the form that the kernels read: in packets of sixteen (Wald et al., Interactive rendering with coherent ray
// tracing, Eurographics 2001).
#pragma once

#include <cstdint>

namespace muro::raycast {

/// Four planes through the device around some rays: all rays have normal * direction >= 0. In the frame of the device.
/// The normals are unit vectors. They are zeros, which cull nothing, if the rays point too far apart.
struct Frustum {
  float x[4] = {}, y[4] = {}, z[4] = {};
};

/// Neighbouring rays, in the frame of the device.
struct alignas(64) RayPacket {
  static constexpr int size = 16;
  double x[size], y[size], z[size];  ///< unit directions; elements from `count` on repeat the last ray
  std::uint32_t ray[size];           ///< number of each ray in the scan
  std::uint32_t count = 0;
  bool quads_are_contiguous = false;  ///< full, and rays 4 k to 4 k + 3 have consecutive numbers, for each k
  Frustum frustum;                    ///< around the rays
};

/// Neighbouring packets: `first` to `first + count` - 1.
struct Sector {
  static constexpr std::uint32_t max_packets = 8;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Frustum frustum;
};

}  // namespace muro::raycast
