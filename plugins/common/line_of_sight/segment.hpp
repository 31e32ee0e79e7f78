// SPDX-License-Identifier: MIT
// A straight line between two points, and tests of it with boxes of a hierarchy, convex shapes, heightmaps, triangles.
#pragma once

#include "muro/scene.hpp"
#include "muro/toolkit/heightmap.hpp"
#include "plugins/common/mesh/mesh.hpp"

namespace muro::line_of_sight {

/// A segment from `start` to `start + way`. A place on it is a number from 0 to 1.
struct Segment {
  Vec3 start, way;  ///< m
  Vec3 per_way;     ///< 1 / way; for 0 a very large number

  static Segment along(const Vec3& start, const Vec3& way) {
    const auto inverse = [](double x) { return x == 0 ? 1e300 : 1 / x; };
    return {start, way, {inverse(way.x()), inverse(way.y()), inverse(way.z())}};
  }
  static Segment between(const Vec3& a, const Vec3& b) { return along(a, b - a); }
  Vec3 end() const { return start + way; }
  /// Returns the segment in the frame whose pose in the present frame is `frame`.
  Segment in(const Pose& frame) const {
    const Quat back = frame.orientation.conjugate();
    return along(back * Vec3(start - frame.position), back * way);
  }
  /// Whether a part of it is in the box. A segment along a face, which does not cut the inside of the box, may count.
  bool touches(const Aabb& box) const {
    double in = 0, out = 1;
    const auto narrow = [&](int k) {  // in the form that compilers translate to minimum and maximum instructions
      const double a = (box.low[k] - start[k]) * per_way[k], b = (box.high[k] - start[k]) * per_way[k];
      const double first = a < b ? a : b, last = a > b ? a : b;
      in = first > in ? first : in;
      out = last < out ? last : out;
    };
    narrow(0), narrow(1), narrow(2);
    return in <= out;
  }
};

/// Whether the segment passes through a box, sphere, cylinder or capsule; false for other shapes. The segment is in the
/// frame of the shape. It does not pass through a shape that holds one of its ends, or that it only touches.
bool passes_through(const Segment& segment, const Shape& shape);

/// Whether the segment passes under the surface of a heightmap, in the frame of its shape; `highest` (m) is the highest
/// point of the surface. An end that is under the surface counts as lying on it.
bool passes_under(const Segment& segment, const Heightmap& ground, double highest);

/// Whether the segment crosses a triangle.
bool crosses(const Segment& segment, const Vec3& a, const Vec3& b, const Vec3& c);

/// Calls visit(item) for the items of all leaves that the segment touches, until one call returns true. Returns whether
/// one did. The bounds of leaves are tested, not those of items.
template <class Visit>
bool any_on(const Bvh& tree, const Segment& segment, Visit visit) {
  if (tree.nodes.empty()) return false;
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const BvhNode& n = tree.nodes[stack[--depth]];
    if (!segment.touches(n.bounds)) continue;
    for (std::uint32_t i = 0; i < n.count; ++i)
      if (visit(tree.items[n.first + i])) return true;
    if (n.count > 0) continue;
    stack[depth++] = n.first + 1;
    stack[depth++] = n.first;
  }
  return false;
}

/// Calls visit(leaf, item) for the items of all leaves that `box` overlaps, as long as it returns true. Returns whether
/// it always did.
template <class Visit>
bool each_leaf(const Bvh& tree, const Aabb& box, Visit visit) {
  if (tree.nodes.empty()) return true;
  std::uint32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const BvhNode& n = tree.nodes[stack[--depth]];
    if (!n.bounds.overlaps(box)) continue;
    for (std::uint32_t i = 0; i < n.count; ++i)
      if (!visit(n, tree.items[n.first + i])) return false;
    if (n.count > 0) continue;
    stack[depth++] = n.first + 1;
    stack[depth++] = n.first;
  }
  return true;
}

}  // namespace muro::line_of_sight
