// SPDX-License-Identifier: MIT
#include "pairs/collide.hpp"

namespace muro::native {
namespace {

/// How deep `point` lies below the plane (m).
double below(const Placed& plane, const Vec3& point) { return plane.axis().dot(plane.centre - point); }

/// `lowest` is a point of the first shape, `depth` below the plane.
void add_lowest(const Vec3& lowest, const Vec3& normal, double depth, Manifold& out) {
  if (depth > 0) out.add(lowest + 0.5 * depth * normal, normal, depth);
}

}  // namespace

void sphere_plane(const Placed& sphere, const Placed& plane, Manifold& out) {
  const Vec3 n = plane.axis();
  add_lowest(sphere.centre - sphere.radius() * n, n, below(plane, sphere.centre) + sphere.radius(), out);
}

/// Every corner below the plane.
void box_plane(const Placed& box, const Placed& plane, Manifold& out) {
  const Vec3 n = plane.axis();
  const Vec3 rise = (box.axes.transpose() * n).cwiseProduct(box.half);  // of the plane's height, centre to face
  const double depth = below(plane, box.centre);
  if (depth + rise.cwiseAbs().sum() <= 0) return;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 s(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double at = depth - s.dot(rise);
    if (at > 0) add_lowest(box.centre + box.axes * s.cwiseProduct(box.half), n, at, out);
  }
}

/// Of each end's rim the lowest point, the highest, and the two between: a cylinder on its side rests on the
/// two ends of its lowest line, one that stands upright on four points of its rim, with all steps between.
void cylinder_plane(const Placed& cylinder, const Placed& plane, Manifold& out) {
  const Vec3 n = plane.axis(), u = cylinder.axis();
  const double slope = n.dot(u), r = cylinder.radius();
  Vec3 down = slope * u - n;  // towards the lowest point of a rim
  const double steep = down.norm();
  const double depth = below(plane, cylinder.centre), rise = cylinder.half.z() * slope;
  if (depth + std::abs(rise) + r * steep <= 0) return;
  // Upright: any four points serve; those on the axes of the cylinder turn with it.
  down = steep > 1e-9 ? Vec3(down * (r / steep)) : Vec3(r * cylinder.axes.col(0));
  for (const double end : {1.0, -1.0}) {
    const Vec3 cap = cylinder.centre + end * cylinder.half.z() * u;
    const double at = depth - end * rise;
    add_lowest(cap + down, n, at + r * steep, out);
    if (at <= 0) continue;
    const Vec3 across = u.cross(down);
    add_lowest(cap + across, n, at, out);
    add_lowest(cap - across, n, at, out);
    add_lowest(cap - down, n, at - r * steep, out);
  }
}

void capsule_plane(const Placed& capsule, const Placed& plane, Manifold& out) {
  const Vec3 n = plane.axis();
  for (const double end : {1.0, -1.0}) {
    const Vec3 centre = capsule.centre + end * capsule.half.z() * capsule.axis();
    add_lowest(centre - capsule.radius() * n, n, below(plane, centre) + capsule.radius(), out);
  }
}

}  // namespace muro::native
