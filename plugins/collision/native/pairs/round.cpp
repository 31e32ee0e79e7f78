// SPDX-License-Identifier: MIT
#include <algorithm>

#include "pairs/collide.hpp"

namespace muro::native {
namespace {

/// Collides two balls of radii `ra` and `rb`. `otherwise`: the normal if the centres coincide.
void balls(const Vec3& a, double ra, const Vec3& b, double rb, const Vec3& otherwise, Manifold& out) {
  const Vec3 gap = a - b;
  const double distance2 = gap.squaredNorm(), reach = ra + rb;
  if (distance2 >= reach * reach) return;
  const double distance = std::sqrt(distance2);
  const Vec3 n = distance > 1e-12 * reach ? Vec3(gap / distance) : otherwise;
  out.add(b + n * (0.5 * (distance + rb - ra)), n, reach - distance);
}

/// Returns the point on the axis of a capsule (m from its centre) that is nearest to `p`.
double nearest_on(const TransformedShape& capsule, const Vec3& p) {
  return std::clamp(capsule.axis().dot(p - capsule.centre), -capsule.half.z(), capsule.half.z());
}
Vec3 on_axis(const TransformedShape& capsule, double s) { return capsule.centre + s * capsule.axis(); }

/// Collides a ball whose centre lies in a solid, `surface` (m) below its nearest face with the normal `outward`.
/// `side`: 1 if the ball is the first shape, -1 if the solid is.
void ball_inside(const Vec3& centre, double radius, const Vec3& outward, double surface, double side, Manifold& out) {
  out.add(centre + outward * (0.5 * (surface - radius)), side * outward, surface + radius);
}

}  // namespace

void sphere_sphere(const TransformedShape& a, const TransformedShape& b, Manifold& out) {
  balls(a.centre, a.radius(), b.centre, b.radius(), Vec3::UnitZ(), out);
}

void sphere_capsule(const TransformedShape& sphere, const TransformedShape& capsule, Manifold& out) {
  balls(sphere.centre, sphere.radius(), on_axis(capsule, nearest_on(capsule, sphere.centre)), capsule.radius(),
        capsule.axes.col(0), out);
}

void box_sphere(const TransformedShape& box, const TransformedShape& sphere, Manifold& out) {
  const Vec3 c = box.axes.transpose() * (sphere.centre - box.centre);
  const Vec3 nearest = c.cwiseMin(box.half).cwiseMax(-box.half);
  const Vec3 gap = nearest - c;
  const double distance2 = gap.squaredNorm(), r = sphere.radius();
  if (distance2 >= r * r) return;
  if (distance2 > 0) {
    const double distance = std::sqrt(distance2);
    const Vec3 n = box.axes * (gap / distance);
    out.add(sphere.centre + n * (0.5 * (distance + r)), n, r - distance);
    return;
  }
  Vec3::Index face;
  const double surface = (box.half - c.cwiseAbs()).minCoeff(&face);
  ball_inside(sphere.centre, r, box.axes.col(face) * (c[face] < 0 ? -1.0 : 1.0), surface, -1, out);
}

void sphere_cylinder(const TransformedShape& sphere, const TransformedShape& cylinder, Manifold& out) {
  const Vec3 u = cylinder.axis(), to = sphere.centre - cylinder.centre;
  const double along = u.dot(to), r = sphere.radius();
  const Vec3 radial = to - along * u;
  const double off2 = radial.squaredNorm(), big = cylinder.radius(), half = cylinder.half.z();
  const double over = std::abs(along) - half;  // beyond an end
  if (over >= r || off2 >= (big + r) * (big + r)) return;
  const double off = std::sqrt(off2), beside = off - big;
  const Vec3 up = along < 0 ? Vec3(-u) : Vec3(u);
  const Vec3 aside = off > 1e-9 * big ? Vec3(radial / off) : Vec3(cylinder.axes.col(0));
  if (over <= 0 && beside <= 0) {  // centre inside: the way out is by the side or the end, whichever is nearer
    const bool by_end = over >= beside;
    ball_inside(sphere.centre, r, by_end ? up : aside, by_end ? -over : -beside, 1, out);
    return;
  }
  const Vec3 gap = std::max(over, 0.0) * up + std::max(beside, 0.0) * aside;
  const double distance = gap.norm();
  if (distance >= r) return;
  const Vec3 n = gap / distance;
  out.add(sphere.centre - n * (0.5 * (distance + r)), n, r - distance);
}

/// Finds the nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9, for segments about
/// centres). Nearly parallel segments overlap in a stretch, and its two ends make the manifold.
void capsule_capsule(const TransformedShape& a, const TransformedShape& b, Manifold& out) {
  const Vec3 u = a.axis(), v = b.axis(), d = b.centre - a.centre, cross = u.cross(v);
  const double la = a.half.z(), lb = b.half.z(), c = u.dot(v), du = d.dot(u), dv = d.dot(v);
  const double sine2 = cross.squaredNorm();
  // s on a, t on b: the solution of the 2x2 system, then clamped one after the other.
  double s = sine2 > 1e-16 ? std::clamp((du - c * dv) / sine2, -la, la) : std::clamp(du, -la, la);
  double t = c * s - dv;
  if (t < -lb || t > lb) {
    t = std::clamp(t, -lb, lb);
    s = std::clamp(c * t + du, -la, la);
  }
  const Vec3 aside = sine2 > 1e-16 ? Vec3(cross / std::sqrt(sine2)) : perpendicular(u);
  balls(on_axis(a, s), a.radius(), on_axis(b, t), b.radius(), aside, out);
  if (sine2 > 1e-8 || out.count == 0) return;
  const double low = std::max(-la, du - lb * std::abs(c)), high = std::min(la, du + lb * std::abs(c));
  if (low >= high) return;
  const double deepest = out.points[0].depth;
  Manifold ends;
  for (const double at : {low, high}) {
    const Vec3 p = on_axis(a, at);
    balls(p, a.radius(), on_axis(b, nearest_on(b, p)), b.radius(), aside, ends);
  }
  const double kept = deepest - 1e-9 * (a.radius() + b.radius());
  if (ends.count == 0) return;
  if (ends.points[0].depth >= kept || ends.points[ends.count - 1].depth >= kept) out.count = 0;
  for (int i = 0; i < ends.count; ++i) out.add(ends.points[i].point, ends.points[i].normal, ends.points[i].depth);
}

}  // namespace muro::native
