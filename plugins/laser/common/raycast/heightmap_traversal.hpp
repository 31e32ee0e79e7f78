// SPDX-License-Identifier: MIT
// Rays on their way over a heightmap.
//
// Sixteen rays are followed in a lane, each with steps of its own. The next step of a ray, up to 2^k blocks long, is
// within one window of the planes of level k (HeightField::planes) wherever it begins, as windows overlap by half. If
// the ray stays above the plane, it has passed this step. Otherwise it moves on to where it meets the plane, and
// continues with smaller windows, whose planes are nearer to the surface. Rays that meet a plane of a smallest window
// are followed from cell to cell (heightmap_walk.hpp). (Tevs, Ihrke and Seidel, Maximum mipmaps for fast, accurate, and
// scalable dynamic height field rendering, I3D 2008, use heights instead of planes, and windows that do not overlap.)
//
// The path of a ray begins where the ray enters the box around the map, so that coordinates stay within the box. Planes
// are raised above the surface by the largest error of floats there: they only show which space is free. Distances are
// computed in doubles.
#pragma once

#include "heightmap_walk.hpp"
#include "packet_traversal.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

/// The rays of a packet. Units are blocks and m; members that are distances along rays are in m.
class GroundRays {
 public:
  alignas(64) double found[RayPacket::size];  ///< m, distance at which each ray hits; infinity if it does not hit

  /// Begins the paths of the rays. `until`: m, distance beyond which a ray need not be followed.
  MURO_INLINE void start(const Ground& g, const PacketSetup& setup, const D (&until)[2]) {
    V3<D> d[2];
    for (int h = 0; h < 2; ++h) {
      const auto along = [&](const V3<double>& axis) {
        return D(axis.x) * setup.direction[h].x + D(axis.y) * setup.direction[h].y + D(axis.z) * setup.direction[h].z;
      };
      // avoids -0: its inverse would reverse the direction of the ray
      d[h] = {along(g.axes.x) * D(1 / g.field.spacing[0]) + D(0), along(g.axes.y) * D(1 / g.field.spacing[1]) + D(0),
              along(g.axes.z) + D(0)};
      store(du_ + 8 * h, d[h].x), store(dv_ + 8 * h, d[h].y), store(dz_ + 8 * h, d[h].z);
      store(found + 8 * h, D(never));
    }
    const auto some = [](F a) { return lane::select(lane::abs(a) < F(1e-20f), F(1e-20f), a); };
    const F u = some(narrow(d[0].x, d[1].x)), v = some(narrow(d[0].y, d[1].y)), z = some(narrow(d[0].z, d[1].z));
    const F iu = F(1) / u, iv = F(1) / v;
    if (g.inside)
      start_inside(g, until, {u, v, z}, {iu, iv, F(1) / z});
    else
      start_outside(g, until, d);
    end_ *= lane::max(lane::abs(u), lane::abs(v)) * F(per_block) * F(1 + 1e-5f);
    D origin[3][2];
    for (int h = 0; h < 2; ++h) {
      const D in = load<D>(from_ + 8 * h);
      origin[0][h] = (D(g.u) + in * d[h].x) * D(per_block);
      origin[1][h] = (D(g.v) + in * d[h].y) * D(per_block);
      origin[2][h] = D(g.z) + in * d[h].z;
    }
    const F pace = lane::min(lane::abs(iu), lane::abs(iv)) * F(HeightField::block);
    store(pace_, pace);
    origin_ = {narrow(origin[0][0], origin[0][1]), narrow(origin[1][0], origin[1][1]),
               narrow(origin[2][0], origin[2][1])};
    along_ = {u * pace * F(per_block), v * pace * F(per_block), z * pace};
    at_ = next_ = F(0), window_ = F(lane::min(8.0f, float(g.field.widest)));
    near_ = 0;
    active_ = lane::mask_of<F>(~signs(end_) & all_signs);
  }

  /// Moves rays on by one window. Returns whether all rays are near the surface or have left the map.
  MURO_INLINE bool march(const Ground& g) {
    const float margin = 1e-6f * float(lane::max(g.field.blocks[0], g.field.blocks[1]) + 3);
    const F last_u(float(g.field.blocks[0]) - 0.25f), last_v(float(g.field.blocks[1]) - 0.25f);
    const F slope_step(float(g.field.slope_step)), widest(float(g.field.widest)), upper_rows(float(g.field.upper_rows)),
        part = F(1) / window_;
    const F to = lane::min(at_ + window_ * F(1 - 4 * margin), end_), step = to - at_;
    const F u = origin_.x + at_ * along_.x, v = origin_.y + at_ * along_.y, z = origin_.z + at_ * along_.z;
    const F least_u = origin_.x + lane::select(along_.x < F(0), to, at_) * along_.x;
    const F least_v = origin_.y + lane::select(along_.y < F(0), to, at_) * along_.y;
    const I i = truncated(lane::min(lane::max(least_u - F(margin), F(0)), last_u) * part);
    const I j = truncated(lane::min(lane::max(least_v - F(margin), F(0)), last_v) * part);
    const I row = truncated(lane::max(upper_rows - (upper_rows + upper_rows) * part, F(0)));
    const I column = truncated(lane::select(part < F(1), F(float(g.field.upper_column)), F(0)));
    const Places64 plane = look_up(g.field.planes, (row + j) * I(std::int32_t(g.field.plane_columns)) + (column + i));
    const F slope_u = to_floats(plane.second) * slope_step, slope_v = to_floats(plane.third) * slope_step;
    const F above =
        (z - plane.first) - (slope_u * (u - to_floats(i) * window_) + slope_v * (v - to_floats(j) * window_));
    const F climb = along_.z - (slope_u * along_.x + slope_v * along_.y), then = above + step * climb;
    const auto free = lane::min(above, then) > F(0), smallest = window_ <= F(1);
    const auto is_near = active_ & (!free) & smallest;
    const F meets = at_ - (above / climb) * F(1 - 1e-5f);
    at_ = lane::select(active_, lane::select(free, to, lane::select(above > F(0), meets, at_)), at_);
    next_ = lane::select(is_near, to, next_);
    const F larger = lane::select(then > F(0.8f) * above, lane::min(window_ + window_, widest), window_);
    window_ = lane::select(active_, lane::select(free, larger, lane::max(window_ * F(0.5f), F(1))), window_);
    active_ = active_ & !(is_near | (free & (to >= end_)));
    near_ |= lane::bits(is_near);
    return !lane::any(active_);
  }

  /// Follows the rays that are near the surface. Returns whether any of them must go on.
  MURO_INLINE bool walk(const Ground& g) {
    alignas(64) float at[RayPacket::size], next[RayPacket::size];
    store(at, at_), store(next, next_);
    unsigned on = 0;
    for (int h = 0; h < 2; ++h) {
      const unsigned rays = near_ >> 8 * h & 0xff;
      if (rays == 0) continue;
      const auto half = [h](const double* numbers) { return load<D>(numbers + 8 * h); };
      const auto widened = [h](const float* numbers) {
        alignas(64) double wide[8];
        for (int i = 0; i < 8; ++i) wide[i] = double(numbers[8 * h + i]);
        return load<D>(wide);
      };
      const D from = half(from_), pace = widened(pace_);
      const WalkingRays walking{half(du_),
                                half(dv_),
                                half(dz_),
                                lane::max(from + widened(at) * pace, half(over_from_)),
                                from + widened(next) * pace,
                                half(over_until_)};
      on |= walk_over_cells(g, walking, rays, found + 8 * h) << 8 * h;
    }
    at_ = next_;
    near_ = 0;
    active_ = lane::mask_of<F>(on) & (next_ < end_);
    return lane::any(active_);
  }

 private:
  static constexpr float per_block = 1.0f / HeightField::block;

  /// Finds where rays are over the map, not below its floor and not above its top. end_: the length of this path, m;
  /// negative if there is none.
  MURO_INLINE void start_inside(const Ground& g, const D (&until)[2], const V3<F>& d, const V3<F>& inverse) {
    const auto out = [](F i, double from, double length) {
      return lane::max(i * F(-float(from)), i * F(float(length - from)));
    };
    const F out_u = out(inverse.x, g.u, g.field.columns - 1), out_v = out(inverse.y, g.v, g.field.rows - 1);
    end_ = lane::min(lane::min(out_u, out_v), narrow(until[0], until[1]));
    const F to_top = inverse.z * F(float(g.high - g.z));
    F in(0);
    if (g.z > g.high) {
      in = lane::select(d.z < F(0), to_top * F(1 - 1e-6f), F(0));
      end_ = lane::select(d.z < F(0), end_ - in, F(-1));
    } else {
      end_ = lane::select(d.z > F(0), lane::min(end_, to_top), end_);
    }
    alignas(64) float from[RayPacket::size];
    store(from, in);
    for (int i = 0; i < RayPacket::size; ++i) from_[i] = double(from[i]);
    for (int h = 0; h < 2; ++h) store(over_from_ + 8 * h, D(0)), store(over_until_ + 8 * h, until[h]);
  }
  MURO_INLINE void start_outside(const Ground& g, const D (&until)[2], const V3<D> (&d)[2]) {
    const auto across = [](double from, D inverse, double length) {
      const D a = D(-from) * inverse, b = D(length - from) * inverse;
      const auto backwards = inverse < D(0);
      return Interval<D>{lane::select(backwards, b, a), lane::select(backwards, a, b)};
    };
    D way[2];
    for (int h = 0; h < 2; ++h) {
      Interval<D> over{D(0), until[h]};
      over.intersect(across(g.u, D(1) / d[h].x, g.field.columns - 1));
      over.intersect(across(g.v, D(1) / d[h].y, g.field.rows - 1));
      const D iz = D(1) / d[h].z, to_floor = D(g.field.low - g.z) * iz, to_top = D(g.high - g.z) * iz;
      const auto rises = d[h].z > D(0), falls = d[h].z < D(0);
      const D not_before(g.field.low > g.z ? never : 0);
      over.in = lane::max(over.in, lane::select(rises, lane::max(to_floor, D(0)), not_before));
      over.out = lane::min(over.out, lane::select(falls, to_floor * D(1 + 1e-12) + D(1e-12), D(never)));
      store(over_from_ + 8 * h, over.in), store(over_until_ + 8 * h, over.out);
      const D in = lane::max(over.in, lane::select(falls, to_top, D(g.z > g.high ? never : 0)));
      const D out = lane::min(over.out, lane::select(rises, to_top, D(never))) * D(1 + 1e-9);
      const auto meets = in <= out;
      store(from_ + 8 * h, lane::select(meets, in, D(0)));
      way[h] = lane::select(meets, out - in, D(-1));
    }
    end_ = narrow(way[0], way[1]);
  }

  V3<F> origin_, along_;        ///< begin of the path; change per unit of at_, which is one block along x or along y
  F at_, end_, window_, next_;  ///< next_: where a ray that is near the surface goes on
  lane::Mask<float, 16> active_;
  unsigned near_;
  alignas(64) double du_[RayPacket::size], dv_[RayPacket::size], dz_[RayPacket::size];
  alignas(64) double over_from_[RayPacket::size], over_until_[RayPacket::size];  ///< m
  alignas(64) double from_[RayPacket::size];                                     ///< m, begin of the path
  alignas(64) float pace_[RayPacket::size];                                      ///< m per unit of at_
};

/// Finds the hits of the rays of some packets. Packets take turns, so that the processor does not wait for memory.
inline void cast_over_ground(const Ground& ground, GroundRays* packets, std::uint32_t count) {
  GroundRays *marching[Sector::max_packets], *near[Sector::max_packets];
  for (std::uint32_t i = 0; i < count; ++i) marching[i] = packets + i;
  while (count > 0) {
    std::uint32_t near_count = 0;
    while (count > 0)
      for (std::uint32_t i = 0; i < count;)
        if (marching[i]->march(ground)) {
          near[near_count++] = marching[i];
          marching[i] = marching[--count];
        } else {
          ++i;
        }
    for (std::uint32_t i = 0; i < near_count; ++i)
      if (near[i]->walk(ground)) marching[count++] = near[i];
  }
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
