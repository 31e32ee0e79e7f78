// SPDX-License-Identifier: MIT
// The scene as the kernels see it: plain numbers, world axes, m.
#pragma once

#include <cstdint>

#include "bundle.hpp"
#include "muro/simd/isa.hpp"

namespace muro::raycast {

enum class SolidKind : std::uint32_t { upright_box, box, sphere, cylinder, capsule };

/// A bounded shape. `axes` and `position` are those of the shape in the world for scenery, in its body for a robot.
struct Solid {
  SolidKind kind = SolidKind::box;  ///< upright: parallel to the world's axes
  std::uint32_t id = 0;             ///< which collider of the scene; of two at one distance the lesser is seen
  double sx = 0, sy = 0, sz = 0;    ///< half lengths of a box; else radius, -, half length along z
  double half[3] = {};              ///< of the box around the shape, in its own axes
  double position[3] = {};
  double axes[9] = {};           ///< the x axis of the shape, then y, then z
  const double* body = nullptr;  ///< pose of a robot's body in the world: position x y z, orientation x y z w
};

/// The half space below a plane: normal * x <= offset.
struct Plane {
  double normal[3] = {};
  double offset = 0;
  std::uint32_t id = 0;
  std::int32_t robot = -1;
};

/// Boxes parallel to the world's axes, in columns. An empty box has low > high.
struct alignas(64) Boxes {
  static constexpr int size = 16;
  float low[3][size], high[3][size];
  std::uint32_t item[size];
};

/// Boxes of two levels: group g lies around blocks 16 g to 16 g + 15. Their coordinates count from `centre`.
struct BoxTable {
  const Boxes* groups = nullptr;
  const Boxes* blocks = nullptr;
  std::uint32_t group_count = 0;
  double centre[3] = {};
  float extent = 0;  ///< m, greatest coordinate
};

struct SolidRange {
  std::uint32_t first = 0, count = 0;
};

struct Sight {
  BoxTable scenery;  ///< items: index of a solid
  BoxTable moving;   ///< items: number of a robot
  const Solid* solids = nullptr;
  const SolidRange* robots = nullptr;  ///< by number
  const Plane* planes = nullptr;
  std::uint32_t plane_count = 0;
};

/// Where a scanner stands and how far it looks.
struct Scanner {
  double position[3] = {};
  double axes[9] = {};  ///< row by row: direction in the world = axes * direction in the device's frame
  double min_range = 0, max_range = 0;
  std::int32_t ignored_robot = -1;  ///< the number of a robot that is not seen; -1: none
  const Bundle* bundles = nullptr;
  const Sector* sectors = nullptr;
  std::uint32_t sector_count = 0;
  double min_slope = 0, max_slope = 0;  ///< of the rays: z / sqrt(x^2 + y^2) in the device's frame
};

/// What may be hit, seen from the scanner. A box here has the scanner as its origin and is a little too large.
struct alignas(64) Candidates {
  static constexpr int size = 16;
  float low[3][size], high[3][size];
  std::uint32_t what[size];  ///< index of a solid, or of a `Visitor` with the highest bit set
  std::uint32_t count;
  float near;  ///< m, these and all that follow are no nearer
};

/// Sixteen boxes of a table as they are seen, some of them candidates.
struct alignas(64) Found {
  float low[3][16], high[3][16];
  std::uint32_t what[16];
};
/// A candidate among them.
struct Place {
  std::uint32_t at;     ///< 16 block + number in it
  std::uint32_t shell;  ///< of its distance
};

/// A robot in reach.
struct Visitor {
  std::uint32_t robot = 0;
  std::int32_t first = -1;  ///< its solids in Memory::placed, once somebody has looked
};

/// A robot's solid where it stands, seen from the scanner.
struct Placed {
  SolidKind kind;
  std::uint32_t id;
  float low[3], high[3];  ///< as in Candidates
  double sx, sy, sz;
  double origin[3];  ///< of the rays, in the frame of the solid
  double axes[9];    ///< as in Solid, in the world
};

/// A plane that rays may reach.
struct Fall {
  double normal[3];
  double height;  ///< m, of the scanner above it
  std::uint32_t id;
};

/// Memory of one scan: room for all boxes of the tables, and for all solids of robots.
struct Memory {
  Found* found = nullptr;
  Place* order = nullptr;
  Candidates* in_reach = nullptr;   ///< two more blocks than are needed
  Candidates* in_sector = nullptr;  ///< likewise
  Visitor* visitors = nullptr;
  Placed* placed = nullptr;
  Fall* falls = nullptr;
};

/// Where the readings go, by number of the ray.
struct Reading {
  double* ranges = nullptr;
  std::int64_t* ids = nullptr;  ///< null: not wanted; the collider that each ray meets, -1 for none
};

struct ScanKernels {
  void (*cast)(const Sight&, const Scanner&, const Memory&, const Reading&);
};
MURO_DECLARE_KERNELS(ScanKernels, scan_kernels)

}  // namespace muro::raycast
