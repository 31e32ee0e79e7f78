// SPDX-License-Identifier: MIT
#include "feature.hpp"

#include <algorithm>

namespace muro::contact_geometry {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double level = 1e-7;  ///< cosine below which a line or face counts as at right angles to a direction

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Feature box_face(const TransformedShape& box, const Vec3& direction) {
  const Vec3 c = box.axes.transpose() * direction;
  int i;
  c.cwiseAbs().maxCoeff(&i);
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const double side = std::copysign(1.0, c[i]);
  Feature f;
  f.count = 4;
  f.normal = side * box.axes.col(i);
  f.centre = box.centre + box.half[i] * f.normal;
  const double sj = std::copysign(box.half[j], c[j]), sk = std::copysign(box.half[k], c[k]);
  const Vec3 vj = sj * box.axes.col(j), vk = sk * box.axes.col(k);
  f.points[0] = f.support = f.centre + vj + vk;
  f.points[1] = f.centre - vj + vk;
  f.points[2] = f.centre - vj - vk;
  f.points[3] = f.centre + vj - vk;
  f.is_unique = c.cwiseAbs().minCoeff() > level;
  return f;
}

Feature cylinder_feature(const TransformedShape& cylinder, const Vec3& direction) {
  const Vec3 u = cylinder.axis();
  const double along = direction.dot(u), end = std::copysign(cylinder.half.z(), along);
  const Vec3 across = direction - along * u;
  const double steep = across.norm();
  Vec3 out =
      steep > level ? Vec3(across * (cylinder.radius() / steep)) : Vec3(cylinder.radius() * cylinder.axes.col(0));
  Feature f;
  f.support = cylinder.centre + end * u + out;
  if (std::abs(along) > 0.7) {
    f.count = 4;
    f.normal = std::copysign(1.0, along) * u;
    f.centre = cylinder.centre + end * u;
    f.disc_radius = cylinder.radius();
    const Vec3 side = u.cross(out);
    f.points[0] = f.support;
    f.points[1] = f.centre + side;
    f.points[2] = f.centre - out;
    f.points[3] = f.centre - side;
    f.is_unique = steep > level;
  } else {
    f.count = 2;
    f.centre = cylinder.centre + out;
    f.points[0] = f.support;
    f.points[1] = f.centre - end * u;
    f.is_unique = std::abs(along) > level;
  }
  return f;
}

Feature capsule_feature(const TransformedShape& capsule, const Vec3& direction) {
  const Vec3 u = capsule.axis();
  const double along = direction.dot(u), end = std::copysign(capsule.half.z(), along);
  Feature f;
  f.centre = capsule.centre + capsule.radius() * direction;
  f.points[0] = f.support = f.centre + end * u;
  f.count = 1;
  f.is_unique = true;
  if (std::abs(along) < 0.7 && capsule.half.z() > 0) {
    f.points[1] = f.centre - end * u;
    f.count = 2;
    f.is_unique = std::abs(along) > level;
  }
  return f;
}

/// A point projected along the normal: its place in the plane at right angles to it, and its height over that.
struct Projected {
  Vec2 at;
  double height;
};

/// The plane at right angles to the normal, with its origin near the contact.
struct Projection {
  Vec3 x, y, z, origin;

  Projection(const Vec3& normal, const Vec3& at)
      : x(perpendicular(normal)), y(normal.cross(x)), z(normal), origin(at) {}
  Projected operator()(const Vec3& p) const {
    const Vec3 d = p - origin;
    return {{x.dot(d), y.dot(d)}, z.dot(d)};
  }
  Vec3 back(const Vec2& at, double height) const { return origin + at.x() * x + at.y() * y + height * z; }
  /// Returns the height of the feature's plane over `at`.
  double height_of(const Feature& f, const Vec2& at) const {
    const Vec3 d = origin - f.centre;
    const double nz = f.normal.dot(z);
    return -(f.normal.dot(d) + at.x() * f.normal.dot(x) + at.y() * f.normal.dot(y)) / nz;
  }
};

/// Clips a polygon (or line) to the part left of the line from p to q, or within `slack` of it.
int clip(const Projected* in, int count, const Vec2& p, const Vec2& q, double slack, Projected* out) {
  const Vec2 along = q - p;
  const double length = along.norm();
  int left = 0;
  if (!(length > 0)) return 0;
  const auto inside = [&](const Projected& s) { return cross(along, s.at - p) / length + slack; };
  const int edges = count == 2 ? 1 : count;  // a line has one edge, and two ends
  for (int i = 0; i < edges; ++i) {
    const Projected &a = in[i], &b = in[(i + 1) % count];
    const double da = inside(a), db = inside(b);
    if (da >= 0) out[left++] = a;
    if (da * db < 0) {
      const double t = da / (da - db);
      out[left++] = {a.at + t * (b.at - a.at), a.height + t * (b.height - a.height)};
    }
    if (count == 2 && db >= 0) out[left++] = b;
  }
  return left;
}

/// Returns the square (m^2) of the length of a line or of the diagonal of a face.
double extent2(const Feature& f) { return (f.points[f.count / 2] - f.points[0]).squaredNorm(); }

/// Clips a line or face against a face.
void clip_against_face(const Feature& f, const Feature& face, const Projection& project, double side, Manifold& out) {
  Projected buffers[2][12], corners[4];
  for (int i = 0; i < 4; ++i) corners[i] = project(face.points[i]);
  const double slack = 1e-9 * std::sqrt(extent2(f));
  const bool left = cross(corners[1].at - corners[0].at, corners[2].at - corners[0].at) > 0;
  int count = f.count, now = 0;
  for (int i = 0; i < count; ++i) buffers[0][i] = project(f.points[i]);
  for (int i = 0; i < 4 && count > 0; ++i, now = 1 - now) {
    const Vec2 &p = corners[i].at, &q = corners[(i + 1) & 3].at;
    count = clip(buffers[now], count, left ? p : q, left ? q : p, slack, buffers[1 - now]);
  }
  for (int i = 0; i < count; ++i) {
    const Projected& s = buffers[now][i];
    const double other = project.height_of(face, s.at), depth = side * (other - s.height);
    if (depth > 0) out.add(project.back(s.at, 0.5 * (other + s.height)), project.z, depth);
  }
}

/// Adds the point where two lines cross or, if they are parallel, the ends of the segment that they share.
void cross_lines(const Feature& a, const Feature& b, const Projection& project, Manifold& out) {
  const Projected a0 = project(a.points[0]), a1 = project(a.points[1]), b0 = project(b.points[0]),
                  b1 = project(b.points[1]);
  const Vec2 u = a1.at - a0.at, v = b1.at - b0.at, d = b0.at - a0.at;
  const double area = cross(u, v), u2 = u.squaredNorm(), v2 = v.squaredNorm();
  const auto add = [&](double s, double t) {
    const double ha = a0.height + s * (a1.height - a0.height), hb = b0.height + t * (b1.height - b0.height);
    if (hb - ha > 0) out.add(project.back(a0.at + s * u, 0.5 * (ha + hb)), project.z, hb - ha);
  };
  if (area * area > 1e-6 * u2 * v2) {
    const double s = cross(d, v) / area, t = cross(d, u) / area;
    if (std::min(s, t) >= -1e-9 && std::max(s, t) <= 1 + 1e-9) add(s, t);
    return;
  }
  if (!(u2 > 0 && v2 > 0)) return;
  const double s0 = u.dot(d) / u2, s1 = s0 + u.dot(v) / u2;
  const double low = std::max(0.0, std::min(s0, s1)), high = std::min(1.0, std::max(s0, s1));
  if (low > high) return;
  for (const double s : {low, high}) {
    add(s, (s - s0) / (s1 - s0));
    if (high - low < 1e-12) break;
  }
}

/// Whether the first feature is the one that is clipped, or projected, against the second.
bool lies_in(const Feature& a, const Feature& b) {
  const bool both_faces = a.count == 4 && b.count == 4;
  return both_faces ? extent2(a) <= extent2(b) : b.count == 4;
}

void overlap(const Feature& a, const Feature& b, bool a_in_b, const Projection& project, Manifold& out) {
  if (a_in_b && a.count > 1)
    clip_against_face(a, b, project, 1, out);
  else if (!a_in_b && a.count == 4 && b.count > 1)
    clip_against_face(b, a, project, -1, out);
  else if (a.count == 2 && b.count == 2)
    cross_lines(a, b, project, out);
}

/// Returns the point of the face or line nearest to `p`, all projected.
Vec2 nearest_in(const Feature& f, const Projection& project, const Vec2& p) {
  const Vec2 centre = project(f.centre).at;
  if (f.disc_radius > 0) {
    const double off = (p - centre).norm();
    return off > f.disc_radius ? Vec2(centre + (p - centre) * (f.disc_radius / off)) : p;
  }
  Vec2 best = project(f.points[0]).at;
  bool in = f.count == 4;
  const double winding = f.count == 4 ? cross(project(f.points[1]).at - best, project(f.points[2]).at - best) : 0;
  for (int i = 0; i < f.count; ++i) {
    const Vec2 a = project(f.points[i]).at, ab = project(f.points[(i + 1) % f.count]).at - a;
    const double t = std::clamp(ab.dot(p - a) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
    const Vec2 q = a + t * ab;
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
    in = in && cross(ab, p - a) * winding >= 0;
  }
  return in ? p : best;
}

/// Returns the deepest point, from the support points of the features.
Vec3 deepest_point(const Feature& a, const Feature& b, const Projection& project, double depth) {
  if (a.is_unique) return a.support + 0.5 * depth * project.z;
  if (b.is_unique) return b.support - 0.5 * depth * project.z;
  Vec2 at = nearest_in(b, project, project(a.centre).at);
  at = nearest_in(a, project, at);
  return project.back(at, project(a.support).height + 0.5 * depth);
}

}  // namespace

Feature feature_towards(const TransformedShape& shape, const Vec3& direction) {
  switch (shape.kind) {
    case ShapeKind::box:
      return box_face(shape, direction);
    case ShapeKind::cylinder:
      return cylinder_feature(shape, direction);
    case ShapeKind::capsule:
      return capsule_feature(shape, direction);
    default:
      break;
  }
  Feature f;
  f.count = 1;
  f.points[0] = f.support = f.centre = shape.centre + shape.radius() * direction;
  f.is_unique = true;
  return f;
}

void add_overlap(const Feature& first, const Feature& second, const Vec3& normal, Manifold& out) {
  const bool first_in_second = lies_in(first, second);
  overlap(first, second, first_in_second, Projection(normal, first_in_second ? first.support : second.support), out);
}

void add_patch(const Feature& a, const Feature& b, const Vec3& normal, double depth, Manifold& out) {
  const bool a_in_b = lies_in(a, b);
  const Projection project(normal, a_in_b ? a.support : b.support);
  overlap(a, b, a_in_b, project, out);
  int deepest = -1;
  for (int i = 0; i < out.count; ++i) {
    double& at = out.points[i].depth;
    at = std::min(at, depth);  // it may be off by the slack of the clipping
    if (deepest < 0 || at > out.points[deepest].depth) deepest = i;
  }
  if (deepest >= 0 && out.points[deepest].depth > depth * (1 - 1e-6)) {
    out.points[deepest].depth = depth;
    return;
  }
  const Vec3 point = deepest_point(a, b, project, depth);
  if (out.count == Manifold::capacity) --out.count;
  out.add(point, normal, depth);
}

}  // namespace muro::contact_geometry
