// SPDX-License-Identifier: MIT
// How a scan is cast. Rays of one scanner start at one point and neighbours see the same things, so the work of
// finding what they see is shared, coarse to fine:
//
//   scan     what is in reach and in the band of elevations, from the hierarchies; sorted by distance
//   sector   of that, what meets the cone around some hundred rays
//   bundle   of that, what meets the cone around 16 rays and no plane around them keeps out
//   rays     the exact intersection, 16 at a time, in the frame of the shape
//
// Candidates come nearest first; a bundle is done when the next one begins behind the farthest of its 16 hits.
#include "caster.hpp"

#include <algorithm>

#include "intersect.hpp"

namespace muro::raycast {

/// The nearest hits of a bundle so far.
struct Caster::Nearest {
  double distance[Bundle::size];
  std::int64_t body[Bundle::size];  ///< ObjectId, as wide as the distance so that both are selected alike; -1: nothing

  double farthest() const {
    double far = distance[0];
    for (int i = 1; i < Bundle::size; ++i) far = std::max(far, distance[i]);
    return far;
  }
  /// Takes over what is nearer.
  void offer(const double (&other)[Bundle::size], ObjectId object) {
    const std::int64_t id = index_of(object);
    for (int i = 0; i < Bundle::size; ++i) {
      const bool nearer = other[i] < distance[i];
      body[i] = nearer ? id : body[i];
      distance[i] = nearer ? other[i] : distance[i];
    }
  }
};

namespace {

/// Whether one of the planes around the rays has the whole box of the candidate on its other side.
bool kept_out(const Bundle& b, const Candidate& c) {
  double most = 0;  // of how far the box lies outside
  for (int k = 0; k < 4; ++k) {
    double inside = b.nx[k] * c.centre.x() + b.ny[k] * c.centre.y() + b.nz[k] * c.centre.z();
    for (int axis = 0; axis < 3; ++axis)
      inside += std::abs(b.nx[k] * c.reach(0, axis) + b.ny[k] * c.reach(1, axis) + b.nz[k] * c.reach(2, axis));
    most = std::max(most, -inside);
  }
  return most > 1e-9;
}

/// Turns the rays into the frame of the candidate and calls enter(dx, dy, dz) for each.
template <class Enter>
void each_ray(const Bundle& b, const Candidate& c, double (&distance)[Bundle::size], Enter enter) {
  const std::array<double, 9> m = c.turn;
  for (int i = 0; i < Bundle::size; ++i) {
    const double x = b.x[i], y = b.y[i], z = b.z[i];
    distance[i] = enter(m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z);
  }
}

void enter(const Bundle& b, const Candidate& c, double (&distance)[Bundle::size]) {
  const double ox = c.origin.x(), oy = c.origin.y(), oz = c.origin.z(), sx = c.sx, sy = c.sy, sz = c.sz;
  switch (c.kind) {
    case ShapeKind::box:
      return each_ray(b, c, distance,
                      [=](double dx, double dy, double dz) { return enter_box(ox, oy, oz, dx, dy, dz, sx, sy, sz); });
    case ShapeKind::sphere:
      return each_ray(b, c, distance,
                      [=](double dx, double dy, double dz) { return enter_ball(ox, oy, oz, dx, dy, dz, sx); });
    case ShapeKind::cylinder:
      return each_ray(b, c, distance,
                      [=](double dx, double dy, double dz) { return enter_cylinder(ox, oy, oz, dx, dy, dz, sx, sz); });
    case ShapeKind::capsule:
      return each_ray(b, c, distance,
                      [=](double dx, double dy, double dz) { return enter_capsule(ox, oy, oz, dx, dy, dz, sx, sz); });
    case ShapeKind::plane:
    case ShapeKind::mesh:
      break;  // no candidates
  }
  std::fill_n(distance, Bundle::size, never);
}

/// Whether a ray of the cone can fall to the plane within `range`.
bool falls(const Cone& cone, const PlaneCandidate& plane, double range) {
  if (plane.height <= 0) return true;
  const double up = plane.normal.dot(cone.axis);
  // the steepest descent: the angle between cone and normal, plus the half angle of the cone, at most pi
  const double steepest =
      up <= -cone.cosine ? -1 : up * cone.cosine - std::sqrt(std::max(0.0, 1 - up * up)) * cone.sine;
  return -steepest * range >= plane.height * (1 - 1e-9);
}

void enter_plane(const Bundle& b, const PlaneCandidate& plane, double (&distance)[Bundle::size]) {
  const double x = plane.normal.x(), y = plane.normal.y(), z = plane.normal.z(), height = plane.height;
  for (int i = 0; i < Bundle::size; ++i) distance[i] = enter_half_space(height, b.x[i] * x + b.y[i] * y + b.z[i] * z);
}

}  // namespace

void Caster::reserve(std::size_t colliders, std::size_t nodes) {
  candidates_.reserve(colliders, nodes);
  in_sector_.reserve(colliders);
}

void Caster::cast(const SceneIndex& scene, const View& view, double min_range, const Pattern& pattern,
                  std::span<double> ranges, std::span<ObjectId> hits) {
  candidates_.gather(scene, view, pattern);
  const ConeList& all = candidates_.cones();
  for (const Sector& sector : pattern.sectors()) {
    in_sector_.clear();
    double margins[ConeList::block];
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i % ConeList::block == 0) all.may_meet(sector.cone, i, margins);
      if (margins[i % ConeList::block] >= 0) in_sector_.push_back(all, i);
    }
    for (const Bundle& bundle : pattern.bundles().subspan(sector.first, sector.count)) {
      Nearest nearest;
      std::fill_n(nearest.distance, Bundle::size, view.max_range);
      std::fill_n(nearest.body, Bundle::size, std::int64_t(-1));
      cast_bundle(bundle, nearest);
      for (std::uint32_t i = 0; i < bundle.count; ++i) ranges[bundle.ray[i]] = std::max(nearest.distance[i], min_range);
      if (hits.empty()) continue;
      for (std::uint32_t i = 0; i < bundle.count; ++i)
        hits[bundle.ray[i]] = nearest.body[i] < 0 ? no_object : ObjectId(std::uint32_t(nearest.body[i]));
    }
  }
}

void Caster::cast_bundle(const Bundle& bundle, Nearest& nearest) const {
  double distance[Bundle::size];
  double far = nearest.farthest();
  for (const PlaneCandidate& plane : candidates_.planes()) {
    if (!falls(bundle.cone, plane, far)) continue;
    enter_plane(bundle, plane, distance);
    nearest.offer(distance, plane.body);
    far = nearest.farthest();
  }
  double margins[ConeList::block];
  for (std::size_t i = 0; i < in_sector_.size() && in_sector_.near(i) < far; ++i) {
    if (i % ConeList::block == 0) in_sector_.may_meet(bundle.cone, i, margins);
    if (margins[i % ConeList::block] < 0) continue;
    const Candidate& candidate = candidates_[in_sector_.candidate(i)];
    if (kept_out(bundle, candidate)) continue;
    enter(bundle, candidate, distance);
    nearest.offer(distance, candidate.body);
    far = nearest.farthest();
  }
}

}  // namespace muro::raycast
