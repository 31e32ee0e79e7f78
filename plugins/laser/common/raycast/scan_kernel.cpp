// SPDX-License-Identifier: MIT
// Casts a scan. All rays of a scanner start at one point, and neighbouring rays hit the same shapes. So the search is
// shared, coarse to fine:
//
//   scan     the boxes in range and between the lowest and the highest elevation, sorted by distance
//   sector   of these, when there are many, those not outside the frustum around some hundred rays
//   packet   of these, those not outside the frustum around 16 rays
//   box      of these, those that one of the 16 rays enters before its nearest hit so far
//   rays     the exact intersection, 8 rays at a time, in the frame of the shape
//
// All steps but the last work in floats, which only drop what is certainly missed (range_culling.hpp). Distances, and
// the decisions at edges and between neighbours, are computed in doubles only.
#include "heightmap_traversal.hpp"

namespace muro::raycast {
namespace {

using namespace rays;

constexpr std::uint32_t many_blocks = 8;  ///< from this number on, culling by sector saves more time than it takes

template <bool with_ids>
class Scan {
 public:
  Scan(const SceneView& view, const ScanQuery& query, const Scratch& scratch, const ScanOutput& output)
      : view_(view), query_(query), scratch_(scratch), output_(output) {}

  void cast() {
    gather_planes();
    const std::uint32_t all = gather_candidates(view_, query_, scratch_);
    for (std::uint32_t i = 0; i < query_.sector_count; ++i) {
      const Sector& sector = query_.sectors[i];
      candidates_ = scratch_.in_range;
      blocks_ = all;
      if (all > many_blocks) cull(sector);
      const RayPacket* packets = query_.packets + sector.first;
      PacketSetup setup[Sector::max_packets];
      for (std::uint32_t b = 0; b < sector.count; ++b)
        setup[b].set(packets[b], query_, blocks_ > 0 ? candidates_ : nullptr);
      if (scratch_.heightmap_count > 0)
        cast_over_heightmaps(packets, setup, sector.count);
      else
        for (std::uint32_t b = 0; b < sector.count; ++b) cast(packets[b], setup[b]);
    }
  }

 private:
  /// Gathers the planes that some ray may hit.
  void gather_planes() {
    for (std::uint32_t i = 0; i < view_.plane_count; ++i) {
      const Plane& plane = view_.planes[i];
      if (plane.robot != no_robot_index && plane.robot == query_.ignored_robot) continue;
      const V3<double> normal = vector_at(plane.normal);
      const double height = dot(normal, vector_at(query_.position)) - plane.offset;
      if (height > query_.max_range * steepest_descent(normal)) continue;
      PlaneCandidate& candidate = scratch_.planes[planes_++];
      put(candidate.normal, normal);
      candidate.height = height;
      candidate.id = plane.id;
    }
  }
  /// Returns the greatest distance (m) that a ray of 1 m moves against the normal. The elevation of a ray above the xy
  /// plane of the device is at least `low`. In the direction in which that plane dips most, by the angle phi between
  /// both normals, the ray points phi - low down.
  double steepest_descent(const V3<double>& normal) const {
    const V3<double> up{query_.axes[2], query_.axes[5], query_.axes[8]};
    const double cosine = dot(normal, up);  // cosine of phi
    const V3<double> across = normal - cosine * up;
    const double sine = lane::sqrt(dot(across, across));
    const double slope = lane::max(lane::min(query_.min_slope, 1e30), -1e30);
    const double flat = 1 / lane::sqrt(1 + slope * slope), rise = slope * flat;  // cosine and sine of low
    return cosine * flat + sine * rise < 0 ? 1 : sine * flat - cosine * rise + 1e-9;
  }

  /// Copies the candidates that may be in the sector.
  void cull(const Sector& sector) {
    FrustumPlanes planes;
    planes.set(sector.frustum, query_);
    Candidates* to = scratch_.in_sector;
    to->count = 0;
    for (std::uint32_t b = 0; b < blocks_; ++b) {
      const Candidates& from = scratch_.in_range[b];
      for (unsigned in = planes.overlapping(from); in != 0; in &= in - 1) {
        const int i = __builtin_ctz(in);
        if (to->count == 0) to->near = from.near;
        for (int k = 0; k < 3; ++k) {
          to->low[k][to->count] = from.low[k][i];
          to->high[k][to->count] = from.high[k][i];
        }
        to->item[to->count] = from.item[i];
        if (++to->count == Candidates::size) (++to)->count = 0;
      }
    }
    candidates_ = scratch_.in_sector;
    blocks_ = std::uint32_t(to - scratch_.in_sector) + (to->count > 0);
  }

  void cast(const RayPacket& packet, const PacketSetup& setup) {
    PacketTraversal<with_ids> rays(setup, query_.max_range);
    for (std::uint32_t i = 0; i < planes_; ++i) rays.intersect_plane(scratch_.planes[i]);
    cast(packet, setup, rays);
  }
  [[gnu::noinline]] void cast_over_heightmaps(const RayPacket* packets, const PacketSetup* setup, std::uint32_t count) {
    PacketTraversal<with_ids> rays[Sector::max_packets];
    for (std::uint32_t b = 0; b < count; ++b) {
      rays[b] = PacketTraversal<with_ids>(setup[b], query_.max_range);
      for (std::uint32_t i = 0; i < planes_; ++i) rays[b].intersect_plane(scratch_.planes[i]);
      for (std::uint32_t i = 0; i < scratch_.heightmap_count; ++i)
        if (scratch_.heightmaps[i].contains_the_start) take_start(scratch_.heightmaps[i], rays[b]);
    }
    GroundRays over[Sector::max_packets];
    for (std::uint32_t k = 0; k < blocks_; ++k) {
      const Candidates& c = candidates_[k];
      for (std::uint32_t i = 0; i < c.count; ++i) {
        if (c.item[i] & robot_bit || view_.primitives[c.item[i]].kind != PrimitiveKind::heightmap) continue;
        const PlacedHeightmap& map = scratch_.heightmaps[view_.primitives[c.item[i]].heightmap];
        if (map.contains_the_start) continue;
        const Ground ground(map);
        std::uint32_t used = 0, packet_of[Sector::max_packets];
        for (std::uint32_t b = 0; b < count; ++b) {
          if (!rays[b].may_pass(c.near) || !rays[b].may_enter({F(c.low[0][i]), F(c.low[1][i]), F(c.low[2][i])},
                                                              {F(c.high[0][i]), F(c.high[1][i]), F(c.high[2][i])}))
            continue;
          over[used].start(ground, setup[b], rays[b].distance);
          packet_of[used++] = b;
        }
        cast_over_ground(ground, over, used);
        for (std::uint32_t n = 0; n < used; ++n) rays[packet_of[n]].take(over[n].found, map.id);
      }
    }
    for (std::uint32_t b = 0; b < count; ++b) cast(packets[b], setup[b], rays[b]);
  }
  MURO_INLINE void cast(const RayPacket& packet, const PacketSetup& setup, PacketTraversal<with_ids>& rays) {
    for (std::uint32_t b = 0; b < blocks_ && rays.may_pass(candidates_[b].near); ++b) {
      const Candidates& c = candidates_[b];
      for (unsigned in = b == 0 ? setup.first : setup.planes.overlapping(c); in != 0; in &= in - 1) {
        const int i = __builtin_ctz(in);
        if (rays.may_enter({F(c.low[0][i]), F(c.low[1][i]), F(c.low[2][i])},
                           {F(c.high[0][i]), F(c.high[1][i]), F(c.high[2][i])}))
          intersect(c.item[i], rays);
      }
    }
    write(packet, rays);
  }

  MURO_INLINE void intersect(std::uint32_t item, PacketTraversal<with_ids>& rays) {
    if (item & robot_bit) return intersect_robot(scratch_.robots[item & ~robot_bit], rays);
    const Primitive& primitive = view_.primitives[item];
    if (primitive.kind == PrimitiveKind::aligned_box) return rays.intersect_aligned_box(primitive, query_);
    if (primitive.kind == PrimitiveKind::heightmap) return;  // see cast_over_heightmaps
    PlacedPrimitive p;
    place_in_scenery(primitive, query_, p);
    rays.intersect(p);
  }

  static void take_start(const PlacedHeightmap& map, PacketTraversal<with_ids>& rays) {
    alignas(64) constexpr double at_once[RayPacket::size] = {};
    rays.take(at_once, map.id);
  }

  [[gnu::noinline]] void intersect_robot(RobotCandidate& candidate, PacketTraversal<with_ids>& rays) {
    const PrimitiveRange& range = view_.robots[candidate.robot];
    if (candidate.first_placed < 0) {
      candidate.first_placed = std::int32_t(placed_);
      for (std::uint32_t i = 0; i < range.count; ++i)
        place_on_robot(view_.primitives[range.first + i], query_, scratch_.placed[placed_++]);
    }
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const PlacedPrimitive& p = scratch_.placed[std::uint32_t(candidate.first_placed) + i];
      if (rays.may_enter(lane::splat<F>(p.low), lane::splat<F>(p.high))) rays.intersect(p);
    }
  }

  MURO_INLINE void write(const RayPacket& packet, const PacketTraversal<with_ids>& rays) {
    alignas(64) double ranges[RayPacket::size];
    for (int h = 0; h < 2; ++h) store(ranges + 8 * h, lane::max(rays.distance[h], D(query_.min_range)));
    if (packet.quads_are_contiguous)
      for (int i = 0; i < RayPacket::size; i += 4) __builtin_memcpy(output_.ranges + packet.ray[i], ranges + i, 32);
    else
      for (std::uint32_t i = 0; i < packet.count; ++i) output_.ranges[packet.ray[i]] = ranges[i];
    if constexpr (with_ids)
      for (std::uint32_t i = 0; i < packet.count; ++i)
        output_.ids[packet.ray[i]] = std::int64_t(rays.id[i / 8][int(i % 8)]);
  }

  const SceneView& view_;
  const ScanQuery& query_;
  const Scratch& scratch_;
  const ScanOutput& output_;
  const Candidates* candidates_ = nullptr;  ///< candidates of the sector
  std::uint32_t blocks_ = 0;                ///< number of blocks of candidates
  std::uint32_t placed_ = 0, planes_ = 0;
};

void cast(const SceneView& view, const ScanQuery& query, const Scratch& scratch, const ScanOutput& output) {
  if (output.ids)
    Scan<true>(view, query, scratch, output).cast();
  else
    Scan<false>(view, query, scratch, output).cast();
}

}  // namespace

namespace MURO_ISA {
extern const ScanKernels scan_kernels;
const ScanKernels scan_kernels{&cast};
}  // namespace MURO_ISA

}  // namespace muro::raycast
