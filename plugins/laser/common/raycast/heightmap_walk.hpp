// SPDX-License-Identifier: MIT
// Follows rays that are near the surface of a heightmap from cell to cell.
#pragma once

#include "intersect.hpp"
#include "primitive_placement.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

/// A heightmap, and the start of the rays.
struct Ground {
  const HeightField& field;
  Axes axes;
  double u, v, z;  ///< start: cells from the corner at -x -y; m
  double high;     ///< m, a little above the highest point
  bool inside;     ///< whether rays start over the map, and not below its floor

  MURO_INLINE explicit Ground(const PlacedHeightmap& map) : field(*map.field), axes(axes_at(map.axes)) {
    u = (map.origin[0] + field.half[0]) / field.spacing[0];
    v = (map.origin[1] + field.half[1]) / field.spacing[1];
    z = map.origin[2];
    high = field.high + 1e-6 * (lane::abs(field.high) + lane::abs(z)) + 1e-9;
    inside = u >= 0 && u <= field.columns - 1 && v >= 0 && v <= field.rows - 1 && z >= field.low;
  }
};

/// Half of the rays of a packet.
struct WalkingRays {
  D du, dv, dz;   ///< direction: cells and m per m
  D from, until;  ///< m, inspected part of the path; it begins at or over the surface, or at the rim
  D over_until;   ///< m, distance at which the ray leaves the space over the map and above its floor
};

/// Writes the distances (m) at which the rays of `which` hit; returns the rays that reach the end of their part without
/// a hit. Neighbouring triangles divide a ray at the same distance, bit for bit, and a ray that is in the solid at the
/// begin or end of its path over a triangle has hit it. So no ray slips through a seam, and no ray from the side passes
/// the wall below the rim.
inline unsigned walk_over_cells(const Ground& g, const WalkingRays& ray, unsigned which, double* found) {
  const HeightField& field = g.field;
  const D iu = D(1) / ray.du, iv = D(1) / ray.dv, iuv = D(1) / (ray.du + ray.dv);
  const D last_column(field.columns - 2), last_row(field.rows - 2);
  const auto within = [](D number, D last) { return lane::min(lane::max(number, D(0)), last); };
  D t = ray.from;
  D column = within(floor(D(g.u) + t * ray.du), last_column), row = within(floor(D(g.v) + t * ray.dv), last_row);
  const auto right = ray.du >= D(0), up = ray.dv >= D(0), upper_first = iuv < D(0);
  const D side_u = lane::select(right, D(1), D(0)), side_v = lane::select(up, D(1), D(0));
  const D next_u = lane::select(right, D(1), D(-1)), next_v = lane::select(up, D(1), D(-1));
  const D scale(field.scale), z(g.z);
  unsigned at_end = 0;
  while (true) {
    const D u = column - D(g.u), v = row - D(g.v);  // relative to the corner at -x -y
    const D out_u = lane::min((u + side_u) * iu, D(never)), out_v = lane::min((v + side_v) * iv, D(never));
    const D out = lane::min(out_u, out_v), diagonal = (u + v + D(1)) * iuv;
    const D number = row * D(field.columns) + column;
    const TwoPlaces low = look_up_two(field.values, number), high = look_up_two(field.values + field.columns, number);
    const D h00 = scale * low.first, h10 = scale * low.second, h01 = scale * high.first, h11 = scale * high.second;
    const D bu0 = h10 - h00, bv0 = h01 - h00, bu1 = h11 - h01, bv1 = h11 - h10;
    const D above0 = z - h00 + bu0 * u + bv0 * v, above1 = z - h11 + bu1 * (u + D(1)) + bv1 * (v + D(1));
    const D climb0 = ray.dz - bu0 * ray.du - bv0 * ray.dv, climb1 = ray.dz - bu1 * ray.du - bv1 * ray.dv;
    // triangles in the order in which the ray meets them
    const D above_a = lane::select(upper_first, above1, above0), above_b = lane::select(upper_first, above0, above1);
    const D climb_a = lane::select(upper_first, climb1, climb0), climb_b = lane::select(upper_first, climb0, climb1);
    const D out_a = lane::min(diagonal, out), in_b = lane::max(diagonal, t);
    const auto in_solid_a = above_a + climb_a * t <= D(0), in_solid_b = above_b + climb_b * in_b <= D(0);
    const auto falls_a = above_a + climb_a * out_a <= D(0), falls_b = above_b + climb_b * out <= D(0);
    const auto hit_a = (t <= out_a) & ((in_solid_a & (t <= ray.over_until)) | ((!in_solid_a) & falls_a));
    const auto hit_b = (in_b <= out) & ((in_solid_b & (in_b <= ray.over_until)) | ((!in_solid_b) & falls_b));
    const unsigned hit = lane::bits(hit_a | hit_b) & which;
    if (hit != 0) {
      const D above = lane::select(hit_a, above_a, above_b), climb = lane::select(hit_a, climb_a, climb_b),
              in = lane::select(hit_a, t, in_b);
      const auto in_solid = above + climb * in <= D(0);
      alignas(64) double where[8];
      store(where, lane::select(in_solid, in, lane::max(-above / climb, in)));
      for (unsigned m = hit; m != 0; m &= m - 1) found[__builtin_ctz(m)] = where[__builtin_ctz(m)];
      which &= ~hit;
      if (which == 0) break;
    }
    const auto sideways = out_u <= out_v;
    column = lane::select(sideways, column + next_u, column);
    row = lane::select(sideways, row, row + next_v);
    const unsigned gone =
        lane::bits((column < D(0)) | (column > last_column) | (row < D(0)) | (row > last_row) | (out > ray.over_until));
    which &= ~gone;
    const unsigned over = lane::bits(out > ray.until) & which;
    at_end |= over;
    which &= ~over;
    if (which == 0) break;
    t = lane::max(out, t);
    column = within(column, last_column), row = within(row, last_row);
  }
  return at_end;
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
