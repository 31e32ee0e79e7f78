// SPDX-License-Identifier: MIT
// How a scan is cast. Rays of one scanner start at one point and neighbours see the same things, so the work of
// finding what they see is shared, coarse to fine:
//
//   scan     what is in reach and in the band of elevations, sorted by distance
//   sector   of that, when it is much, what is not outside the planes around some hundred rays
//   bundle   of that, what is not outside the planes around 16 rays
//   box      of that, where one of the 16 rays meets the box around the shape before anything found so far
//   rays     the exact intersection, 8 at a time, in the frame of the shape
//
// All but the last in floats, which drop only what is certain to be missed (reach.hpp); distances, and the decisions at
// edges and between neighbours, come from doubles alone.
#include "rays.hpp"

namespace muro::raycast {
namespace {

using namespace rays;

constexpr std::uint32_t many_blocks = 8;  ///< from there on narrowing down for a sector takes less time than it saves

template <bool with_ids>
class Scan {
 public:
  Scan(const Sight& sight, const Scanner& scanner, const Memory& memory, const Reading& reading)
      : sight_(sight), scanner_(scanner), memory_(memory), reading_(reading) {}

  void cast() {
    gather_planes();
    const std::uint32_t all = gather(sight_, scanner_, memory_);
    for (std::uint32_t i = 0; i < scanner_.sector_count; ++i) {
      const Sector& sector = scanner_.sectors[i];
      list_ = memory_.in_reach;
      blocks_ = all;
      if (all > many_blocks) narrow_down(sector);
      const Bundle* bundles = scanner_.bundles + sector.first;
      Ready ready[Sector::most];
      for (std::uint32_t b = 0; b < sector.count; ++b)
        ready[b].set(bundles[b], scanner_, blocks_ > 0 ? list_ : nullptr);
      for (std::uint32_t b = 0; b < sector.count; ++b) cast(bundles[b], ready[b]);
    }
  }

 private:
  /// The planes that some ray may reach.
  void gather_planes() {
    for (std::uint32_t i = 0; i < sight_.plane_count; ++i) {
      const Plane& plane = sight_.planes[i];
      if (plane.robot >= 0 && plane.robot == scanner_.ignored_robot) continue;
      const V3<double> normal = vector_at(plane.normal);
      const double height = dot(normal, vector_at(scanner_.position)) - plane.offset;
      if (height > scanner_.max_range * steepest(normal)) continue;
      Fall& f = memory_.falls[falls_++];
      put(f.normal, normal);
      f.height = height;
      f.id = plane.id;
    }
  }
  /// How far (m) a ray of 1 m falls against the normal, at most. Its elevation above the xy plane of the device is at
  /// least `low`; where that plane dips most, by the angle phi to the one of the normal, it points phi - low down.
  double steepest(const V3<double>& normal) const {
    const V3<double> up{scanner_.axes[2], scanner_.axes[5], scanner_.axes[8]};
    const double cosine = dot(normal, up);  // of phi
    const V3<double> across = normal - cosine * up;
    const double sine = lane::sqrt(dot(across, across));
    const double slope = lane::max(lane::min(scanner_.min_slope, 1e30), -1e30);
    const double flat = 1 / lane::sqrt(1 + slope * slope), rise = slope * flat;  // cosine and sine of low
    return cosine * flat + sine * rise < 0 ? 1 : sine * flat - cosine * rise + 1e-9;
  }

  /// Copies what may be in the sector.
  void narrow_down(const Sector& sector) {
    Planes planes;
    planes.set(sector.frustum, scanner_);
    Candidates* to = memory_.in_sector;
    to->count = 0;
    for (std::uint32_t b = 0; b < blocks_; ++b) {
      const Candidates& from = memory_.in_reach[b];
      for (unsigned in = planes.let_in(from); in != 0; in &= in - 1) {
        const int i = __builtin_ctz(in);
        if (to->count == 0) to->near = from.near;
        for (int k = 0; k < 3; ++k) {
          to->low[k][to->count] = from.low[k][i];
          to->high[k][to->count] = from.high[k][i];
        }
        to->what[to->count] = from.what[i];
        if (++to->count == Candidates::size) (++to)->count = 0;
      }
    }
    list_ = memory_.in_sector;
    blocks_ = std::uint32_t(to - memory_.in_sector) + (to->count > 0);
  }

  void cast(const Bundle& bundle, const Ready& ready) {
    Rays<with_ids> rays(ready, scanner_.max_range);
    for (std::uint32_t i = 0; i < falls_; ++i) rays.meet_plane(memory_.falls[i]);
    for (std::uint32_t b = 0; b < blocks_ && rays.pass(list_[b].near); ++b) {
      const Candidates& c = list_[b];
      for (unsigned in = b == 0 ? ready.first : ready.planes.let_in(c); in != 0; in &= in - 1) {
        const int i = __builtin_ctz(in);
        if (rays.enter_bounds({F(c.low[0][i]), F(c.low[1][i]), F(c.low[2][i])},
                              {F(c.high[0][i]), F(c.high[1][i]), F(c.high[2][i])}))
          meet(c.what[i], rays);
      }
    }
    read_out(bundle, rays);
  }

  MURO_INLINE void meet(std::uint32_t what, Rays<with_ids>& rays) {
    if (what & visitor_bit) return meet_robot(memory_.visitors[what & ~visitor_bit], rays);
    const Solid& solid = sight_.solids[what];
    if (solid.kind == SolidKind::upright_box) return rays.meet_upright(solid, scanner_);
    Placed p;
    see(solid, scanner_, p);
    rays.meet(p);
  }

  [[gnu::noinline]] void meet_robot(Visitor& visitor, Rays<with_ids>& rays) {
    const SolidRange& range = sight_.robots[visitor.robot];
    if (visitor.first < 0) {
      visitor.first = std::int32_t(placed_);
      for (std::uint32_t i = 0; i < range.count; ++i)
        place(sight_.solids[range.first + i], scanner_, memory_.placed[placed_++]);
    }
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const Placed& p = memory_.placed[std::uint32_t(visitor.first) + i];
      if (rays.enter_bounds(lane::splat<F>(p.low), lane::splat<F>(p.high))) rays.meet(p);
    }
  }

  MURO_INLINE void read_out(const Bundle& bundle, const Rays<with_ids>& rays) {
    alignas(64) double read[Bundle::size];
    for (int h = 0; h < 2; ++h) store(read + 8 * h, lane::max(rays.distance[h], D(scanner_.min_range)));
    if (bundle.in_fours)
      for (int i = 0; i < Bundle::size; i += 4) __builtin_memcpy(reading_.ranges + bundle.ray[i], read + i, 32);
    else
      for (std::uint32_t i = 0; i < bundle.count; ++i) reading_.ranges[bundle.ray[i]] = read[i];
    if constexpr (with_ids)
      for (std::uint32_t i = 0; i < bundle.count; ++i)
        reading_.ids[bundle.ray[i]] = std::int64_t(rays.id[i / 8][int(i % 8)]);
  }

  const Sight& sight_;
  const Scanner& scanner_;
  const Memory& memory_;
  const Reading& reading_;
  const Candidates* list_ = nullptr;  ///< of the sector
  std::uint32_t blocks_ = 0;          ///< of it
  std::uint32_t placed_ = 0, falls_ = 0;
};

void cast(const Sight& sight, const Scanner& scanner, const Memory& memory, const Reading& reading) {
  if (reading.ids)
    Scan<true>(sight, scanner, memory, reading).cast();
  else
    Scan<false>(sight, scanner, memory, reading).cast();
}

}  // namespace

namespace MURO_ISA {
extern const ScanKernels scan_kernels;
const ScanKernels scan_kernels{&cast};
}  // namespace MURO_ISA

}  // namespace muro::raycast
