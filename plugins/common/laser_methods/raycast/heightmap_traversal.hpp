// SPDX-License-Identifier: MIT
// The sixteen rays of a packet on their way over a heightmap.
//
// All rays start at one point, so one order of the nodes of its tree is front to back for all of them. Floats drop
// nodes, as they drop boxes (range_culling.hpp). A node is the box around its part of the surface, where rays enter the
// solid; at the rim it goes down to the floor, for there are walls. What is left are pairs of a ray and a cell, which
// are intersected eight at a time, in doubles.
#pragma once

#include "packet_traversal.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

/// The order of the 4 x 4 children of a node: by their distance, in columns and rows, from the one that is nearest to
/// where the rays start. Along a ray neither distance decreases, so that no ray meets a later one first.
struct ChildOrder {
  std::uint8_t rank[16][16];   ///< of a child, by the nearest child
  std::uint8_t child[16][16];  ///< of a rank
};
constexpr ChildOrder make_child_order() {
  ChildOrder order{};
  for (int nearest = 0; nearest < 16; ++nearest) {
    int rank = 0;
    for (int distance = 0; distance <= 6; ++distance)
      for (int child = 0; child < 16; ++child) {
        const int across = child % 4 - nearest % 4, along = child / 4 - nearest / 4;
        if ((across < 0 ? -across : across) + (along < 0 ? -along : along) != distance) continue;
        order.rank[nearest][child] = std::uint8_t(rank);
        order.child[nearest][rank++] = std::uint8_t(child);
      }
  }
  return order;
}
inline constexpr ChildOrder child_order = make_child_order();

inline constexpr float child_column[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
inline constexpr float child_row[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// Rays over a cell, columns and rows as units across and along.
struct RaysOverCell {
  D column, row;              ///< of the cell
  D h00, h10, h01, h11;       ///< m: its corners, at -x -y, +x -y, -x +y, +x +y
  D du, dv, dz, iu, iv, iuv;  ///< direction, and 1 / du, 1 / dv, 1 / (du + dv)
};

/// Where the rays start: column, row, and height (m); and the lowest height of the map.
struct RayStart {
  double u, v, z, low;
};

/// Where rays first are in the solid below a cell. Neighbouring triangles divide a ray at the same distance, bit for
/// bit, and a ray that is in the solid at the start of its way over a triangle has hit it there: so none slips through
/// a seam, and none that comes from beside passes the wall below the rim.
MURO_INLINE D enter_cell(const RaysOverCell& c, const RayStart& from) {
  const D u = c.column - D(from.u), v = c.row - D(from.v);  // of the corner at -x -y
  const auto between = [](Interval<D>& way, D first, D last, D inverse) {
    const auto backwards = inverse < D(0);
    way.intersect({lane::select(backwards, last, first) * inverse, lane::select(backwards, first, last) * inverse});
  };
  Interval<D> way{D(0), D(never)};
  between(way, u, u + D(1), c.iu);
  between(way, v, v + D(1), c.iv);
  // from the side, no deeper than the lowest point; or up through the floor
  const D to_floor = D(from.low - from.z) / c.dz;
  const auto rises = c.dz > D(0);
  const D not_before(from.low > from.z ? never : 0);
  way.in = lane::max(way.in, lane::select(rises, lane::max(to_floor, D(0)), not_before));
  const D side_until = lane::select(c.dz < D(0), to_floor * D(1 + 1e-12) + D(1e-12), D(never));
  const D to_diagonal = (u + v + D(1)) * c.iuv;
  const auto upper_first = c.iuv < D(0);
  D nearest(never);
  const auto meet = [&](bool upper) {
    Interval<D> on = way;
    const auto second = upper ? !upper_first : upper_first;
    on.in = lane::select(second, lane::max(to_diagonal, on.in), on.in);
    on.out = lane::select(second, on.out, lane::min(to_diagonal, on.out));
    const D bu = upper ? c.h11 - c.h01 : c.h10 - c.h00, bv = upper ? c.h11 - c.h10 : c.h01 - c.h00;
    const D above = upper ? D(from.z) - c.h11 + bu * (u + D(1)) + bv * (v + D(1)) : D(from.z) - c.h00 + bu * u + bv * v;
    const D climb = c.dz - bu * c.du - bv * c.dv;
    const D in_solid = lane::select(on.in <= side_until, on.in, D(never));
    const D falls = lane::max(-above / climb, on.in);
    const D falls_in = lane::select((climb < D(0)) & (falls <= on.out), falls, D(never));
    const D at = lane::select(above + climb * on.in <= D(0), in_solid, falls_in);
    nearest = lane::min(lane::select(on.in <= on.out, at, D(never)), nearest);
  };
  meet(false);
  meet(true);
  return nearest;
}

class HeightmapTraversal {
 public:
  /// `far` (m): beyond which a ray need not be followed.
  HeightmapTraversal(const PlacedHeightmap& map, const PacketSetup& setup, F far)
      : field_(*map.field), to_(map.origin) {
    const Axes axes = axes_at(map.axes);
    D local[2][3];
    for (int h = 0; h < 2; ++h) {
      const V3<D>& d = setup.direction[h];
      const auto along = [&](const V3<double>& axis) { return D(axis.x) * d.x + D(axis.y) * d.y + D(axis.z) * d.z; };
      const D x = along(axes.x), y = along(axes.y), z = along(axes.z);
      local[h][0] = x, local[h][1] = y, local[h][2] = z;
      const D u = x * D(1 / field_.spacing[0]), v = y * D(1 / field_.spacing[1]);
      store(du_ + 8 * h, u), store(dv_ + 8 * h, v), store(dz_ + 8 * h, z);
      store(iu_ + 8 * h, D(1) / u), store(iv_ + 8 * h, D(1) / v), store(iuv_ + 8 * h, D(1) / (u + v));
      store(found + 8 * h, D(never));
    }
    const auto inverse_of = [](F a) { return F(1) / lane::select(lane::abs(a) < F(1e-20f), F(1e-20f), a); };
    inverse_ = {inverse_of(narrow(local[0][0], local[1][0])), inverse_of(narrow(local[0][1], local[1][1])),
                inverse_of(narrow(local[0][2], local[1][2]))};
    for (int k = 0; k < 4; ++k) {
      const float x = setup.planes.x[k], y = setup.planes.y[k], z = setup.planes.z[k];
      planes_.x[k] = float(axes.x.x) * x + float(axes.x.y) * y + float(axes.x.z) * z;
      planes_.y[k] = float(axes.y.x) * x + float(axes.y.y) * y + float(axes.y.z) * z;
      planes_.z[k] = float(axes.z.x) * x + float(axes.z.y) * y + float(axes.z.z) * z;
    }
    start_ = {(to_[0] + field_.half[0]) / field_.spacing[0], (to_[1] + field_.half[1]) / field_.spacing[1], to_[2],
              field_.low};
    const double away = lane::max(lane::max(lane::abs(to_[0]), lane::abs(to_[1])), lane::abs(to_[2]));
    margin_ = float((double(field_.extent) + away) * 2 * slack + min_slack);
    from_below_ = to_[2] <= field_.low;
    far_ = far;
    store(far_of_, far);
  }

  void cast() {
    visit(field_.level_count - 1, 0, 0, 1u << (2 * (field_.level_count - 1)));
    intersect_pairs();
  }

  alignas(64) double found[RayPacket::size];  ///< m: where each ray hits; infinity for those that do not

 private:
  /// A node of a level, and the width of its children in cells.
  void visit(std::uint32_t level, std::uint32_t column, std::uint32_t row, std::uint32_t width) {
    const HeightLevel& l = field_.levels[level];
    Candidates boxes;
    boxes.count = Candidates::size;
    const double from[2] = {double(4 * column) * width, double(4 * row) * width};  // in cells
    for (int k = 0; k < 2; ++k) {
      const F first(float(from[k] * field_.spacing[k] - field_.half[k] - to_[k])),
          side(float(width * field_.spacing[k]));
      const F number = load<F>(k == 0 ? child_column : child_row);
      store(boxes.low[k], first + number * side - F(margin_));
      store(boxes.high[k], lane::min(first + (number + F(1)) * side, F(float(field_.half[k] - to_[k]))) + F(margin_));
    }
    const HeightNode& n = l.nodes[std::size_t(row) * ((l.columns + 3) / 4) + column];
    const float up = margin_ - float(to_[2]), down = -margin_ - float(to_[2]);
    for (int i = 0; i < 16; ++i) {
      boxes.low[2][i] = n.low + n.step * float(n.lowest[i]) + down;
      boxes.high[2][i] = n.low + n.step * float(n.highest[i]) + up;
    }
    if (from_below_) store(boxes.low[2], F(float(field_.low) + down));
    const std::uint32_t columns = l.columns - 4 * column, rows = l.rows - 4 * row;
    unsigned there = columns >= 4 ? 0xffff : ((1u << columns) - 1) * 0x1111;
    if (rows < 4) there &= (1u << 4 * rows) - 1;
    const int nearest = nearest_child(start_.u - from[0], width) + 4 * nearest_child(start_.v - from[1], width);
    unsigned sorted = 0;
    for (unsigned in = planes_.overlapping(boxes) & there; in != 0; in &= in - 1)
      sorted |= 1u << child_order.rank[nearest][__builtin_ctz(in)];
    for (; sorted != 0; sorted &= sorted - 1) {
      const int i = child_order.child[nearest][__builtin_ctz(sorted)];
      const unsigned entering = rays_entering({F(boxes.low[0][i]), F(boxes.low[1][i]), F(boxes.low[2][i])},
                                              {F(boxes.high[0][i]), F(boxes.high[1][i]), F(boxes.high[2][i])});
      if (entering == 0) continue;
      const std::uint32_t c = 4 * column + std::uint32_t(i) % 4, r = 4 * row + std::uint32_t(i) / 4;
      if (level > 0)
        visit(level - 1, c, r, width / 4);
      else
        add_pairs(entering, c, r);
    }
  }
  MURO_INLINE static int nearest_child(double at, std::uint32_t width) {
    const double child = at / width;
    return child >= 3 ? 3 : child > 0 ? int(child) : 0;
  }

  /// Bit i: whether ray i may enter the box before its nearest hit so far.
  MURO_INLINE unsigned rays_entering(const V3<F>& low, const V3<F>& high) const {
    const F x0 = low.x * inverse_.x, x1 = high.x * inverse_.x, y0 = low.y * inverse_.y, y1 = high.y * inverse_.y,
            z0 = low.z * inverse_.z, z1 = high.z * inverse_.z;
    const F in = lane::max(lane::max(lane::min(x0, x1), lane::min(y0, y1)), lane::min(z0, z1));
    const F out = lane::min(lane::min(lane::max(x0, x1), lane::max(y0, y1)), lane::max(z0, z1));
    return ~signs(lane::min(lane::min(out, far_) - in, out)) & all_signs;
  }

  MURO_INLINE void add_pairs(unsigned entering, std::uint32_t column, std::uint32_t row) {
    const float* values = field_.values + std::size_t(row) * field_.columns + column;
    const double h00 = field_.scale * double(values[0]), h10 = field_.scale * double(values[1]),
                 h01 = field_.scale * double(values[field_.columns]),
                 h11 = field_.scale * double(values[field_.columns + 1]);
    for (; entering != 0; entering &= entering - 1) {
      const int ray = __builtin_ctz(entering);
      const std::uint32_t i = pairs_.count++;
      pairs_.ray[i] = ray;
      pairs_.column[i] = column, pairs_.row[i] = row;
      pairs_.h00[i] = h00, pairs_.h10[i] = h10, pairs_.h01[i] = h01, pairs_.h11[i] = h11;
      pairs_.du[i] = du_[ray], pairs_.dv[i] = dv_[ray], pairs_.dz[i] = dz_[ray];
      pairs_.iu[i] = iu_[ray], pairs_.iv[i] = iv_[ray], pairs_.iuv[i] = iuv_[ray];
      if (pairs_.count == Pairs::size) intersect_pairs();
    }
  }

  void intersect_pairs() {
    const std::uint32_t count = pairs_.count;
    pairs_.count = 0;
    if (count == 0) return;
    const Pairs& p = pairs_;
    const auto at = [](const double* numbers) { return load<D>(numbers); };
    alignas(64) double distance[Pairs::size];
    store(distance, enter_cell({at(p.column), at(p.row), at(p.h00), at(p.h10), at(p.h01), at(p.h11), at(p.du), at(p.dv),
                                at(p.dz), at(p.iu), at(p.iv), at(p.iuv)},
                               start_));
    for (std::uint32_t i = 0; i < count; ++i) {
      const int ray = p.ray[i];
      if (!(distance[i] < found[ray])) continue;
      found[ray] = distance[i];
      far_of_[ray] = lane::min(far_of_[ray], float(distance[i]) * (1 + slack));
    }
    far_ = load<F>(far_of_);
  }

  /// Rays and cells that they may hit.
  struct Pairs {
    static constexpr std::uint32_t size = 8;
    alignas(64) double column[size] = {}, row[size] = {};
    alignas(64) double h00[size] = {}, h10[size] = {}, h01[size] = {}, h11[size] = {};
    alignas(64) double du[size] = {}, dv[size] = {}, dz[size] = {}, iu[size] = {}, iv[size] = {}, iuv[size] = {};
    int ray[size] = {};
    std::uint32_t count = 0;
  };

  const HeightField& field_;
  const double* to_;  ///< m: where the rays start, in the frame of the map
  RayStart start_;
  V3<F> inverse_;  ///< 1 / direction, large instead of infinite
  FrustumPlanes planes_;
  float margin_;     ///< m, by which boxes are larger than they are
  bool from_below_;  ///< rays start below the lowest height: some may come through the floor
  F far_;
  alignas(64) float far_of_[RayPacket::size];
  alignas(64) double du_[RayPacket::size], dv_[RayPacket::size], dz_[RayPacket::size];
  alignas(64) double iu_[RayPacket::size], iv_[RayPacket::size], iuv_[RayPacket::size];
  Pairs pairs_;
};

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
