// SPDX-License-Identifier: MIT
#pragma once

#include "terrain_facets.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Steps through the triangles of a heightmap under a straight line. Three families of parallel lines divide the
/// triangles: the columns, the rows, and the lines across the cells, on which the sum of column and row is a whole
/// number.
template <class S>
class FacetWay {
 public:
  Facet<S> before, now;  ///< they share an edge that the line crosses

  /// Starts at a point over `from` and ends at a point over `to`. The points may be slightly beside these triangles.
  MURO_INLINE FacetWay(const TerrainGrid& grid, const Facet<S>& from, const V3<S>& start, const Facet<S>& to,
                       const V3<S>& end)
      : now(from) {
    const Number first = number_of(from), last = number_of(to);
    const S u = (start.x + S(grid.half_x)) * S(grid.per_spacing_x),
            v = (start.y + S(grid.half_y)) * S(grid.per_spacing_y);
    const S du = (end.x - start.x) * S(grid.per_spacing_x), dv = (end.y - start.y) * S(grid.per_spacing_y);
    column_ = family(first.column, last.column, u, du);
    row_ = family(first.row, last.row, v, dv);
    across_ = family(first.across, last.across, u + v, du + dv);
  }

  /// Goes on to the next triangle. Returns the lanes in which there is one.
  MURO_INLINE MaskOf<S> step(const TerrainGrid& grid) {
    const auto by_column = all_of(column_.at < row_.at, column_.at < across_.at);
    const auto by_row = all_of(!by_column, row_.at < across_.at);
    const auto by_across = all_of(!by_column, !by_row, across_.at < S(far));
    column_.cross(by_column), row_.cross(by_row), across_.cross(by_across);
    const S upper = across_.number - column_.number - row_.number;
    const auto is_facet = all_of(any_of(by_column, by_row, by_across), upper >= S(0), upper <= S(1));
    before = now;
    // where there is none, this takes any triangle
    now = facet_of<S>(grid, select(is_facet, column_.number, S(0)), select(is_facet, row_.number, S(0)),
                      all_of(is_facet, upper > S(0)));
    return is_facet;
  }

 private:
  static constexpr double far = 1e300;
  /// Numbers of the lines of each family between which a triangle lies.
  struct Number {
    S column, row, across;
  };
  /// The lines of one family.
  struct Family {
    S number;     ///< number of the line before the present triangle
    S at;         ///< where the next line is crossed, as a part of the whole way; `far`: nowhere
    S last;       ///< `number` at the end
    S direction;  ///< 1, or -1
    S per;        ///< part of the way between two lines

    MURO_INLINE void cross(MaskOf<S> which) {
      number += select(which, direction, S(0));
      at += select(which, per, S(0));
      at = select(number == last, S(far), at);
    }
  };
  MURO_INLINE static Number number_of(const Facet<S>& f) {
    const S upper = select(f.side < S(0), S(1), S(0));
    const S column = f.column - upper, row = f.row - upper;
    return {column, row, column + row + upper};
  }
  MURO_INLINE static Family family(S first, S last, S start, S length) {
    Family f;
    f.number = first, f.last = last;
    f.direction = select(last < first, S(-1), S(1));
    const S line = first + select(last < first, S(0), S(1));
    f.per = S(1) / abs(length);
    f.at = select(first == last, S(far), (line - start) * f.direction * f.per);
    return f;
  }

  Family column_, row_, across_;
};

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
