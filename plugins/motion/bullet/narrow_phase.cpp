// SPDX-License-Identifier: MIT
#include "narrow_phase.hpp"

#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexConcaveCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btSphereSphereCollisionAlgorithm.h>

#include <algorithm>
#include <cmath>

#include "plane_contacts.hpp"

namespace muro::bullet {

namespace {

/// Number of directions about the normal in which the smaller shape is turned a little to find more points when shapes
/// have flat faces (van den Bergen). GJK alone gives one point per pair.
constexpr int perturbation_count = 4;
constexpr double min_cosine = 0.999;  ///< cosine: a normal this near to that of a box's face counts as equal

bool is_round(const Collider& c) { return c.kind == ShapeKind::sphere; }
bool has_corners(const Collider& c) { return c.kind == ShapeKind::box || c.kind == ShapeKind::mesh; }

/// A face of a box; finds the parts of another shape over it.
class BoxFace {
 public:
  BoxFace(const Collider& box, int axis, double sign) {
    const btMatrix3x3& axes = box.pose.getBasis();
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    u_ = from_bullet(axes.getColumn(i));
    v_ = from_bullet(axes.getColumn(j));
    half_u_ = 0.5 * box.size[i];
    half_v_ = 0.5 * box.size[j];
    const Vec3 n = sign * from_bullet(axes.getColumn(axis));
    middle_ = from_bullet(box.pose.getOrigin()) + 0.5 * box.size[axis] * n;
    plane_ = btTransform(btMatrix3x3(u_.x(), v_.x(), n.x(), u_.y(), v_.y(), n.y(), u_.z(), v_.z(), n.z()),
                         to_bullet(middle_));
  }
  const btTransform& plane() const { return plane_; }
  bool contains(const ContactPoint& p) const {
    const Vec3 from = p.position - middle_;
    return std::abs(from.dot(u_)) <= half_u_ && std::abs(from.dot(v_)) <= half_v_;
  }
  /// Finds the ends of the part of the line from `a` to `b` that is over the face; returns their number.
  int clip(const ContactPoint& a, const ContactPoint& b, ContactPoint* out) const {
    const Vec3 from = a.position - middle_, span = b.position - a.position;
    double begin = 0, end = 1;
    const auto cut = [&](double at, double speed, double half) {
      if (speed == 0) {
        if (std::abs(at) > half) end = -1;
        return;
      }
      const double x = (-half - at) / speed, y = (half - at) / speed;
      begin = std::max(begin, std::min(x, y));
      end = std::min(end, std::max(x, y));
    };
    cut(from.dot(u_), span.dot(u_), half_u_);
    cut(from.dot(v_), span.dot(v_), half_v_);
    if (begin >= end) return 0;
    for (int k = 0; k < 2; ++k) {
      const double t = k == 0 ? begin : end;
      out[k] = {a.position + t * span, a.normal, a.gap + t * (b.gap - a.gap)};
    }
    return 2;
  }

 private:
  Vec3 u_, v_, middle_;
  double half_u_ = 0, half_v_ = 0;
  btTransform plane_;
};

/// Finds where `other` touches the face of `box` with the normal `outward` (world), like a plane within the face.
/// Returns -1 when no face touches.
int face_contacts(const Collider& box, const Collider& other, const Vec3& outward, ContactPoint* out) {
  for (int axis = 0; axis < 3; ++axis) {
    const double along = outward.dot(from_bullet(box.pose.getBasis().getColumn(axis)));
    if (std::abs(along) < min_cosine) continue;
    const BoxFace face(box, axis, along > 0 ? 1 : -1);
    ContactPoint points[NarrowPhase::max_points];
    const int found = plane_contacts(other, face.plane(), points);
    int count = found > 1 ? face.clip(points[0], points[1], out) : 0;
    for (int i = found > 1 ? 2 : 0; i < found; ++i)
      if (face.contains(points[i])) out[count++] = points[i];
    return count;
  }
  return -1;
}

Pose pose_of(const Collider& c) {
  const btQuaternion q = c.pose.getRotation();
  return {from_bullet(c.pose.getOrigin()), Quat(q.w(), q.x(), q.y(), q.z())};
}

int terrain_contacts(const Collider& a, const Collider& terrain, ContactPoint* out) {
  static_assert(terrain_contact::max_contacts <= NarrowPhase::max_points);
  terrain_contact::ConvexShape shape = a.convex;
  shape.pose = pose_of(a);
  terrain_contact::TerrainContacts found;
  const int count =
      terrain_contact::find_contacts(terrain.heightmap, pose_of(terrain), shape, NarrowPhase::margin, found);
  for (int i = 0; i < count; ++i) {
    const auto& [position, normal, gap] = found[std::size_t(i)];
    out[i] = {position, normal, gap};
  }
  return count;
}

}  // namespace

NarrowPhase::NarrowPhase() : manifold_(&first_, &second_, 0, margin, margin) {
  first_.setWorldTransform(btTransform::getIdentity());
  second_.setWorldTransform(btTransform::getIdentity());
}

int NarrowPhase::collide(const Collider& a, const Collider& b, int perturbations, ContactPoint* out) {
  first_.setCollisionShape(a.shape.get());
  second_.setCollisionShape(b.shape.get());
  const btCollisionObjectWrapper wrap_a(nullptr, a.shape.get(), &first_, a.pose, -1, -1);
  const btCollisionObjectWrapper wrap_b(nullptr, b.shape.get(), &second_, b.pose, -1, -1);
  btCollisionAlgorithmConstructionInfo make(&dispatcher_, 0);
  make.m_manifold = &manifold_;
  manifold_.setNumContacts(0);
  btManifoldResult result(&wrap_a, &wrap_b);
  result.setPersistentManifold(&manifold_);
  if (b.shape->isConcave()) {
    make.m_manifold = nullptr;
    btConvexConcaveCollisionAlgorithm algorithm(make, &wrap_a, &wrap_b, false);
    algorithm.processCollision(&wrap_a, &wrap_b, info_, &result);
    manifolds_.resizeNoInitialize(0);
    algorithm.getAllContactManifolds(manifolds_);
    int n = 0;
    for (int i = 0; i < manifolds_.size() && n + 4 <= max_points; ++i)
      n += read(*manifolds_[i], manifolds_[i]->getBody0() == &first_ ? 1 : -1, out + n);
    return n;
  }
  if (a.kind == ShapeKind::box && b.kind == ShapeKind::box) {
    btBoxBoxCollisionAlgorithm algorithm(&manifold_, make, &wrap_a, &wrap_b);
    algorithm.processCollision(&wrap_a, &wrap_b, info_, &result);
  } else if (is_round(a) && is_round(b)) {
    btSphereSphereCollisionAlgorithm algorithm(&manifold_, make, &wrap_a, &wrap_b);
    algorithm.processCollision(&wrap_a, &wrap_b, info_, &result);
  } else {
    btConvexConvexAlgorithm algorithm(&manifold_, make, &wrap_a, &wrap_b, &depth_solver_, perturbations, perturbations);
    algorithm.processCollision(&wrap_a, &wrap_b, info_, &result);
  }
  return read(manifold_, 1, out);
}

int NarrowPhase::find(const Collider& a, const Collider& b, ContactPoint* out) {
  if (b.kind == ShapeKind::plane) return plane_contacts(a, b.pose, out);
  if (b.kind == ShapeKind::heightmap) return terrain_contacts(a, b, out);
  const int n = collide(a, b, 0, out);
  if (n == 0 || is_round(a) || is_round(b) || (has_corners(a) && has_corners(b)) || b.shape->isConcave()) return n;
  const ContactPoint deepest = out[0];
  int count = -1;
  if (b.kind == ShapeKind::box) {
    count = face_contacts(b, a, deepest.normal, out);
  } else if (a.kind == ShapeKind::box) {
    count = face_contacts(a, b, -deepest.normal, out);
    for (int i = 0; i < count; ++i) out[i].normal = -out[i].normal;
  }
  if (count < 0) return collide(a, b, perturbation_count, out);
  if (count < 2) out[count++] = deepest;  // beyond the edges of the face
  return count;
}

int NarrowPhase::read(const btPersistentManifold& manifold, double sign, ContactPoint* out) {
  const int n = manifold.getNumContacts();
  for (int i = 0; i < n; ++i) {
    const btManifoldPoint& p = manifold.getContactPoint(i);
    out[i].normal = sign * from_bullet(p.m_normalWorldOnB);
    out[i].gap = p.getDistance();
    out[i].position = 0.5 * (from_bullet(p.getPositionWorldOnA()) + from_bullet(p.getPositionWorldOnB()));
  }
  return n;
}

}  // namespace muro::bullet
