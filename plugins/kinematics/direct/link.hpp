// SPDX-License-Identifier: MIT
// Kernels: pose and twist of every body from those of the base and the joints (Featherstone, Rigid Body Dynamics
// Algorithms, Springer 2008, chapter 4), with velocities in world axes at the origins of the bodies' frames.
#pragma once

#include <cstdint>

#include "muro/lane/isa.hpp"

namespace muro::kinematics {

/// A frame relative to the nearest frame below it that a joint moves (or the base): fixed frames in between are
/// folded in, so a chain of fixed frames costs no more than one, and errors do not add up along it.
struct Link {
  enum class Joint : std::uint32_t { fixed, revolute, prismatic };
  std::uint32_t parent = 0;  ///< frame it is placed from, smaller than its own
  Joint joint = Joint::fixed;
  bool turned = false;            ///< `turn` is not the identity
  double offset[3] = {0, 0, 0};   ///< m, of this frame's origin in the parent's frame, joint at 0
  double turn[4] = {0, 0, 0, 1};  ///< quaternion x y z w of this frame in the parent's, joint at 0
  double axis[3] = {1, 0, 0};     ///< unit, in the parent's frame

  friend bool operator==(const Link&, const Link&) = default;
};

/// Where the state of a frame lies; joint position (rad or m) and velocity are null for fixed frames.
struct Place {
  double* pose = nullptr;   ///< position x y z, orientation x y z w
  double* twist = nullptr;  ///< linear, angular
  const double* position = nullptr;
  const double* velocity = nullptr;
};

/// The state of a robot: frame 0, then the others in the order of the links.
struct Body {
  const double* pose = nullptr;
  const double* twist = nullptr;
  const Place* places = nullptr;
};

struct Kernels {
  /// Fills in pose and twist of all frames but 0 of one robot, or of eight of the same chain: the same bits.
  void (*place_one)(const Link* links, std::uint32_t count, const Body* robot);
  void (*place_eight)(const Link* links, std::uint32_t count, const Body* robots);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::kinematics
