// SPDX-License-Identifier: MIT
// The scene and the scan in the form that the kernels read: plain numbers, world axes, m.
#pragma once

#include <cstdint>

#include "muro/simd/isa.hpp"
#include "ray_packet.hpp"

namespace muro::raycast {

enum class PrimitiveKind : std::uint32_t { aligned_box, box, sphere, cylinder, capsule, heightmap };

/// index_of(no_robot): kernels know no objects.
inline constexpr std::uint32_t no_robot_index = 0xffffffffu;

/// A bounded shape. `axes` and `position` are those of the shape in the world for scenery, in its body for a robot.
struct Primitive {
  PrimitiveKind kind = PrimitiveKind::box;  ///< aligned_box: parallel to the axes of the world
  std::uint32_t id = 0;                     ///< number of its collider; at equal distances the lesser number is hit
  double sx = 0, sy = 0, sz = 0;            ///< half lengths of a box; otherwise radius, -, half length along z
  double half[3] = {};                      ///< half lengths of the box around the shape, in the axes of the shape
  double position[3] = {};
  double axes[9] = {};           ///< the x axis of the shape, then y, then z
  const double* body = nullptr;  ///< pose of a robot's body in the world: position x y z, orientation x y z w
  std::uint32_t heightmap = 0;   ///< its number in Scratch::heightmaps
};

/// A plane over a part of a heightmap; it is nowhere below the surface. The part is a square window. The height is that
/// of the plane over the corner of the window at -x -y. The slopes are multiples of HeightField::slope_step.
struct HeightPlane {
  float height = 0;  ///< m
  std::int16_t slope_x = 0, slope_y = 0;
};

/// A heightmap in the frame of its shape.
struct HeightField {
  const float* values = nullptr;  ///< values at the nodes, `columns` in a row
  std::uint32_t columns = 0, rows = 0;
  double scale = 0;                      ///< m: height of a value of 1
  double low = 0, high = 0;              ///< m: lowest and greatest height
  double spacing[2] = {}, half[2] = {};  ///< m, distance of nodes; half lengths
  /// One plane for each window. The blocks of a level have 2^level x 2^level times block x block cells. A window has 2
  /// x 2 blocks, and each block is the one at -x -y of one window. The planes of level 0 begin at column and row 0.
  /// Those of a greater level begin at column `upper_column` and row `upper_rows` (1 - 2 / 2^level).
  const HeightPlane* planes = nullptr;
  std::uint32_t plane_columns = 0, upper_column = 0, upper_rows = 0;
  std::uint32_t widest = 1;                  ///< 2^level of the last level
  double slope_step = 0;                     ///< m per block
  double blocks[2] = {};                     ///< numbers of blocks in x and y, not always whole numbers
  static constexpr std::uint32_t block = 1;  ///< cells
};

/// The half space below a plane: normal * x <= offset.
struct Plane {
  double normal[3] = {};
  double offset = 0;
  std::uint32_t id = 0;
  std::uint32_t robot = no_robot_index;
};

/// Sixteen boxes parallel to the axes of the world, as a structure of arrays. An empty box has low > high.
struct alignas(64) BoxBlock {
  static constexpr int size = 16;
  float low[3][size], high[3][size];
  std::uint32_t item[size];
};

/// A hierarchy of two levels: box g of the groups encloses all boxes of block g. Coordinates are relative to `centre`.
struct BoxTable {
  const BoxBlock* groups = nullptr;
  const BoxBlock* blocks = nullptr;
  std::uint32_t group_count = 0;
  double centre[3] = {};
  float extent = 0;  ///< m, greatest absolute coordinate
};

struct PrimitiveRange {
  std::uint32_t first = 0, count = 0;
};

/// All shapes that rays can hit.
struct SceneView {
  BoxTable scenery;  ///< items: index of a primitive
  BoxTable moving;   ///< items: number of a robot
  const Primitive* primitives = nullptr;
  const PrimitiveRange* robots = nullptr;  ///< by number of the robot
  const Plane* planes = nullptr;
  std::uint32_t plane_count = 0;
};

/// The rays of a scan: position, range and directions of the scanner.
struct ScanQuery {
  double position[3] = {};
  double axes[9] = {};  ///< row by row: direction in the world = axes * direction in the device's frame
  double min_range = 0, max_range = 0;
  std::uint32_t ignored_robot = no_robot_index;  ///< a robot that is not seen
  const RayPacket* packets = nullptr;
  const Sector* sectors = nullptr;
  std::uint32_t sector_count = 0;
  double min_slope = 0, max_slope = 0;  ///< limits of z / sqrt(x^2 + y^2) of the rays in the device's frame
};

/// Shapes that rays may hit. The boxes are relative to the scanner and a little too large.
struct alignas(64) Candidates {
  static constexpr int size = 16;
  float low[3][size], high[3][size];
  std::uint32_t item[size];  ///< index of a primitive, or of a `RobotCandidate` with the highest bit set
  std::uint32_t count;
  float near;  ///< m, lower bound of the distance of these and all later candidates
};

/// Sixteen boxes of a table relative to the scanner, some of them candidates.
struct alignas(64) RelativeBoxes {
  float low[3][16], high[3][16];
  std::uint32_t item[16];
};
/// One candidate of the blocks of RelativeBoxes.
struct CandidateRef {
  std::uint32_t index;         ///< 16 times the number of the block + number in the block
  std::uint32_t distance_bin;  ///< bin of its box
};

/// A robot in range.
struct RobotCandidate {
  std::uint32_t robot = 0;
  std::int32_t first_placed = -1;  ///< first of its primitives in Scratch::placed; -1 until a ray enters its box
};

/// A robot's primitive at its present pose, relative to the scanner.
struct PlacedPrimitive {
  PrimitiveKind kind;
  std::uint32_t id;
  float low[3], high[3];  ///< see Candidates
  double sx, sy, sz;
  double origin[3];  ///< start of the rays in the frame of the primitive
  double axes[9];    ///< see Primitive; in the world
};

/// A heightmap of the scenery, placed relative to the start of the rays.
struct PlacedHeightmap {
  const HeightField* field;
  std::uint32_t id;         ///< number of its collider
  bool contains_the_start;  ///< whether rays start on or under the surface
  double origin[3];         ///< start of the rays in the frame of the map
  double axes[9];           ///< see Primitive; in the world
};

/// A plane that rays may hit.
struct PlaneCandidate {
  double normal[3];
  double height;  ///< m, height of the scanner above the plane
  std::uint32_t id;
};

/// Memory of one scan: enough for all boxes of the tables and for all primitives of robots.
struct Scratch {
  RelativeBoxes* boxes = nullptr;
  CandidateRef* order = nullptr;
  Candidates* in_range = nullptr;   ///< two more blocks than needed
  Candidates* in_sector = nullptr;  ///< two more blocks than needed
  RobotCandidate* robots = nullptr;
  PlacedPrimitive* placed = nullptr;
  PlaneCandidate* planes = nullptr;
  const PlacedHeightmap* heightmaps = nullptr;  ///< all heightmaps, placed before the scan
  std::uint32_t heightmap_count = 0;
};

/// Destination of the results, by number of the ray.
struct ScanOutput {
  double* ranges = nullptr;
  std::int64_t* ids = nullptr;  ///< number of the collider that each ray hits, -1 for none; null: not written
};

struct ScanKernels {
  void (*cast)(const SceneView&, const ScanQuery&, const Scratch&, const ScanOutput&);
};
MURO_DECLARE_KERNELS(ScanKernels, scan_kernels)

}  // namespace muro::raycast
