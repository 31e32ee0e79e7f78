// SPDX-License-Identifier: MIT
// How a scan is cast. Rays of one scanner start at one point and neighbours see the same things, so the work of
// finding what they see is shared, coarse to fine:
//
//   scan     what is in reach and in the band of elevations, sorted by distance
//   sector   of that, what is not outside the planes around some hundred rays
//   bundle   of that, what is not outside the planes around 16 rays
//   box      of the 16 rays, those that meet the box around the shape before anything found so far
//   rays     the exact intersection, 8 at a time, in the frame of the shape
//
// All but the last in floats, which drop only what is certain to be missed (reach.hpp); distances and the decisions at
// edges come from doubles alone.
#include "intersect.hpp"
#include "placing.hpp"
#include "sight.hpp"

namespace muro::raycast {
namespace {

using namespace rays;

/// The rays of a bundle on their way. Two lanes of doubles, one of floats.
struct Rays {
  V3<D> d[2];        ///< directions in the world
  V3<D> inverse[2];  ///< 1 / d, once `inverted`
  D distance[2];     ///< to the nearest hit so far
  D id[2];           ///< of what it hits; -1: nothing
  F far;             ///< not less than distance
  V3<F> about;       ///< 1 / d, finite
  bool inverted[2] = {false, false};

  MURO_INLINE Rays(const Bundle& b, const Scanner& s) {
    const double* m = s.axes;
    for (int h = 0; h < 2; ++h) {
      const D x = load<D>(b.x + 8 * h), y = load<D>(b.y + 8 * h), z = load<D>(b.z + 8 * h);
      d[h] = {D(m[0]) * x + D(m[1]) * y + D(m[2]) * z, D(m[3]) * x + D(m[4]) * y + D(m[5]) * z,
              D(m[6]) * x + D(m[7]) * y + D(m[8]) * z};
      distance[h] = D(s.max_range);
      id[h] = D(-1);
    }
    far = F(float(s.max_range) * (1 + slack));
  }
  MURO_INLINE V3<F> rounded() const { return {narrow(d[0].x, d[1].x), narrow(d[0].y, d[1].y), narrow(d[0].z, d[1].z)}; }
  /// Readies the rays for boxes.
  MURO_INLINE void invert_about() {
    const auto inverse_of = [](F a) { return F(1) / lane::select(lane::abs(a) < F(1e-20f), F(1e-20f), a); };
    const V3<F> r = rounded();
    about = {inverse_of(r.x), inverse_of(r.y), inverse_of(r.z)};
  }
  /// The rays that may meet the box not farther than what they meet so far.
  MURO_INLINE unsigned into_box(const V3<F>& low, const V3<F>& high) const {
    const F x0 = low.x * about.x, x1 = high.x * about.x, y0 = low.y * about.y, y1 = high.y * about.y,
            z0 = low.z * about.z, z1 = high.z * about.z;
    const F in = lane::max(lane::max(lane::min(x0, x1), lane::min(y0, y1)), lane::min(z0, z1));
    const F out = lane::min(lane::min(lane::max(x0, x1), lane::max(y0, y1)), lane::max(z0, z1));
    return signs(lane::min(lane::min(out, far) - in, out)) ^ all_signs;
  }
  template <bool with_ids>
  MURO_INLINE void offer(int h, D found, double whose) {
    if constexpr (with_ids) {
      const auto nearer = (found < distance[h]) | ((found == distance[h]) & (D(whose) < id[h]));
      id[h] = lane::select(nearer, D(whose), id[h]);
    }
    distance[h] = lane::min(found, distance[h]);
  }
  MURO_INLINE void shorten() { far = narrow(distance[0], distance[1]) * F(1 + slack); }
};

MURO_INLINE V3<D> splat(const double* n) { return lane::splat<D>(n); }

/// Directions in the frame of a solid.
MURO_INLINE V3<D> turned(const Placed& p, const V3<D>& d) {
  return {dot(splat(p.axes), d), dot(splat(p.axes + 3), d), dot(splat(p.axes + 6), d)};
}

/// Half of the rays against a solid.
MURO_INLINE D enter(const Placed& p, Rays& rays, int h) {
  const V3<D> o = splat(p.origin);
  switch (p.kind) {
    case SolidKind::upright_box:
      if (!rays.inverted[h]) {
        rays.inverse[h] = {D(1) / rays.d[h].x, D(1) / rays.d[h].y, D(1) / rays.d[h].z};
        rays.inverted[h] = true;
      }
      return enter_box(o, rays.inverse[h], p.sx, p.sy, p.sz);
    case SolidKind::box: {
      const V3<D> d = turned(p, rays.d[h]);
      return enter_box(o, {D(1) / d.x, D(1) / d.y, D(1) / d.z}, p.sx, p.sy, p.sz);
    }
    case SolidKind::sphere:
      return enter_ball(o, turned(p, rays.d[h]), p.sx);
    case SolidKind::cylinder:
      return enter_cylinder(o, turned(p, rays.d[h]), p.sx, p.sz);
    case SolidKind::capsule:
      break;
  }
  return enter_capsule(o, turned(p, rays.d[h]), p.sx, p.sz);
}

template <bool with_ids>
[[gnu::noinline]] void meet(const Placed& p, unsigned which, Rays& rays) {
  for (int h = 0; h < 2; ++h)
    if (which >> (8 * h) & 255) rays.offer<with_ids>(h, enter(p, rays, h), p.id);
  rays.shorten();
}

/// The planes of a frustum in the world.
struct Planes {
  float x[4], y[4], z[4];

  MURO_INLINE Planes(const Frustum& f, const Scanner& s) {
    float m[9];
    for (int k = 0; k < 9; ++k) m[k] = float(s.axes[k]);
    for (int k = 0; k < 4; ++k) {
      x[k] = m[0] * f.x[k] + m[1] * f.y[k] + m[2] * f.z[k];
      y[k] = m[3] * f.x[k] + m[4] * f.y[k] + m[5] * f.z[k];
      z[k] = m[6] * f.x[k] + m[7] * f.y[k] + m[8] * f.z[k];
    }
  }
  /// Those that have no plane between them and the rays.
  MURO_INLINE unsigned let_in(const Candidates& c) const {
    F least(0);
    for (int k = 0; k < 4; ++k) {  // the corner that lies farthest along the normal
      const float* cx = (x[k] > 0 ? c.high : c.low)[0];
      const float* cy = (y[k] > 0 ? c.high : c.low)[1];
      const float* cz = (z[k] > 0 ? c.high : c.low)[2];
      least = lane::min(load<F>(cx) * F(x[k]) + load<F>(cy) * F(y[k]) + load<F>(cz) * F(z[k]), least);
    }
    return ~signs(least) & ((1u << c.count) - 1);
  }
};

template <bool with_ids>
class Caster {
 public:
  Caster(const Sight& sight, const Scanner& scanner, const Memory& memory, const Reading& reading)
      : sight_(sight), scanner_(scanner), memory_(memory), reading_(reading) {}

  void cast() {
    const std::uint32_t all = gather(sight_, scanner_, memory_);
    for (std::uint32_t i = 0; i < scanner_.sector_count; ++i) {
      const Sector& sector = scanner_.sectors[i];
      list_ = memory_.in_reach;
      blocks_ = all;
      if (scanner_.sector_count > 1 && all > 8) narrow_down(sector);
      for (std::uint32_t b = 0; b < sector.count; ++b) cast(scanner_.bundles[sector.first + b]);
    }
  }

 private:
  void narrow_down(const Sector& sector) {
    const Planes planes(sector.frustum, scanner_);
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

  void cast(const Bundle& bundle) {
    Rays rays(bundle, scanner_);
    for (std::uint32_t i = 0; i < sight_.plane_count; ++i) fall(sight_.planes[i], rays);
    if (blocks_ > 0) {
      const Planes planes(bundle.frustum, scanner_);
      bool ready = false;
      for (std::uint32_t b = 0; b < blocks_; ++b) {
        const Candidates& c = list_[b];
        if (signs(rays.far - F(c.near)) == all_signs) break;
        unsigned in = planes.let_in(c);
        if (in != 0 && !ready) {
          rays.invert_about();
          ready = true;
        }
        for (; in != 0; in &= in - 1) {
          const int i = __builtin_ctz(in);
          const unsigned which = rays.into_box({F(c.low[0][i]), F(c.low[1][i]), F(c.low[2][i])},
                                               {F(c.high[0][i]), F(c.high[1][i]), F(c.high[2][i])});
          if (which != 0) reach(c.what[i], which, rays);
        }
      }
    }
    read_out(bundle, rays);
  }

  MURO_INLINE void fall(const Plane& plane, Rays& rays) {
    if (plane.robot >= 0 && plane.robot == scanner_.ignored_robot) return;
    const double height = dot(vector_at(plane.normal), vector_at(scanner_.position)) - plane.offset;
    const V3<F> d = rays.rounded();
    const F down =
        d.x * F(-float(plane.normal[0])) + d.y * F(-float(plane.normal[1])) + d.z * F(-float(plane.normal[2]));
    if (height > 0 && signs((down + F(slack)) * rays.far - F(float(height) * (1 - slack))) == all_signs) return;
    for (int h = 0; h < 2; ++h)
      rays.template offer<with_ids>(h, enter_half_space(D(height), dot(splat(plane.normal), rays.d[h])), plane.id);
    rays.shorten();
  }

  MURO_INLINE void reach(std::uint32_t what, unsigned which, Rays& rays) {
    if (what & visitor_bit) return reach_robot(memory_.visitors[what & ~visitor_bit], rays);
    const Solid& solid = sight_.solids[what];
    Placed p;
    if (solid.kind == SolidKind::upright_box) {
      p.kind = solid.kind, p.id = solid.id, p.sx = solid.sx, p.sy = solid.sy, p.sz = solid.sz;
      for (int k = 0; k < 3; ++k) p.origin[k] = scanner_.position[k] - solid.position[k];
    } else {
      see(solid, scanner_, p);
    }
    meet<with_ids>(p, which, rays);
  }

  [[gnu::noinline]] void reach_robot(Visitor& visitor, Rays& rays) {
    const SolidRange& range = sight_.robots[visitor.robot];
    if (visitor.first < 0) {
      visitor.first = std::int32_t(placed_);
      for (std::uint32_t i = 0; i < range.count; ++i)
        place(sight_.solids[range.first + i], scanner_, memory_.placed[placed_++]);
    }
    for (std::uint32_t i = 0; i < range.count; ++i) {
      const Placed& p = memory_.placed[std::uint32_t(visitor.first) + i];
      const unsigned which = rays.into_box(lane::splat<F>(p.low), lane::splat<F>(p.high));
      if (which != 0) meet<with_ids>(p, which, rays);
    }
  }

  MURO_INLINE void read_out(const Bundle& bundle, const Rays& rays) {
    alignas(64) double buffer[Bundle::size];
    for (int h = 0; h < 2; ++h) store(buffer + 8 * h, lane::max(rays.distance[h], D(scanner_.min_range)));
    if (bundle.in_fours)
      for (int i = 0; i < Bundle::size; i += 4) __builtin_memcpy(reading_.ranges + bundle.ray[i], buffer + i, 32);
    else
      for (std::uint32_t i = 0; i < bundle.count; ++i) reading_.ranges[bundle.ray[i]] = buffer[i];
    if constexpr (with_ids)
      for (std::uint32_t i = 0; i < bundle.count; ++i)
        reading_.ids[bundle.ray[i]] = std::int64_t(rays.id[i / 8][int(i % 8)]);
  }

  const Sight& sight_;
  const Scanner& scanner_;
  const Memory& memory_;
  const Reading& reading_;
  const Candidates* list_ = nullptr;  ///< of the sector
  std::uint32_t blocks_ = 0;
  std::uint32_t placed_ = 0;
};

void cast(const Sight& sight, const Scanner& scanner, const Memory& memory, const Reading& reading) {
  if (reading.ids)
    Caster<true>(sight, scanner, memory, reading).cast();
  else
    Caster<false>(sight, scanner, memory, reading).cast();
}

}  // namespace

namespace MURO_ISA {
extern const ScanKernels scan_kernels;
const ScanKernels scan_kernels{&cast};
}  // namespace MURO_ISA

}  // namespace muro::raycast
