// SPDX-License-Identifier: MIT
// Boxes and hulls on a heightmap: corners on triangles, and ridges in faces.
#include <cmath>
#include <limits>

#include "shape_contacts.hpp"

namespace muro::terrain_contact {

namespace {

/// Least upward component of a normal; a face with less supports nothing.
constexpr double least_rise = 0.02;

struct Face {
  Vec3 normal;  ///< unit, outward, in the frame of the shape
  double offset;
};

void add_corner(const Surface& surface, const Vec3& corner, ContactCollector& contacts) {
  if (const auto ground = surface.map().ground_at(corner.x(), corner.y()))
    contacts.add_on_shape(corner, ground->normal, (corner.z() - ground->height) * ground->normal.z());
}

/// A ridge in a shape with faces: the part of it that is inside.
template <class FaceAt>
class RidgeInFaces {
 public:
  RidgeInFaces(const Surface& surface, const SurfaceEdge& edge, const Pose& pose, const Pose& back, int faces,
               const FaceAt& face)
      : surface_(surface),
        edge_(edge),
        pose_(pose),
        count_(faces),
        face_(face),
        from_(back * edge.begin),
        to_(back * edge.end) {}

  void add_to(ContactCollector& contacts) {
    if (!clip()) return;
    const bool first = add_end(begin_, begin_face_, edge_.first, contacts),
               second = add_end(end_, end_face_, edge_.second, contacts);
    if (!first && !second) add_middle(contacts);
  }

 private:
  Vec3 at(double part) const { return from_ + part * (to_ - from_); }

  bool clip() {
    for (int i = 0; i < count_; ++i) {
      const Face f = face_(i);
      const double a = f.normal.dot(from_) - f.offset, b = f.normal.dot(to_) - f.offset;
      if (a > 0 && b > 0) return false;
      if (a > 0 && a / (a - b) > begin_) begin_ = a / (a - b), begin_face_ = i;
      if (b > 0 && a / (a - b) < end_) end_ = a / (a - b), end_face_ = i;
    }
    return begin_ < end_;
  }

  /// Adds a contact at an end: through the face with the shortest way out that the ridge may push, except the one that
  /// cuts it off.
  bool add_end(double part, int cut_by, const std::uint32_t (&node)[2], ContactCollector& contacts) {
    const Vec3 point = at(part);
    double least = std::numeric_limits<double>::infinity();
    Vec3 best;
    for (int i = 0; i < count_; ++i) {
      if (i == cut_by) continue;
      const Face f = face_(i);
      const double depth = f.offset - f.normal.dot(point);
      if (depth >= least) continue;
      const Vec3 up = pose_.orientation * Vec3(-f.normal);
      if (up.z() < least_rise || !edge_.allows(up)) continue;
      if (cut_by < 0 && !surface_.allows(node[0], node[1], up)) continue;
      least = depth, best = up;
    }
    if (!std::isfinite(least)) return false;
    contacts.add_on_terrain(pose_ * point, best, -least);
    return true;
  }

  /// Handles an edge or a corner of the shape on the ridge: the way out is along the ridge's own normal.
  void add_middle(ContactCollector& contacts) {
    const Vec3 point = at(0.5 * (begin_ + end_)), down = pose_.orientation.conjugate() * Vec3(-edge_.normal);
    double depth = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count_; ++i) {
      const Face f = face_(i);
      if (const double speed = f.normal.dot(down); speed > 1e-9)
        depth = std::min(depth, (f.offset - f.normal.dot(point)) / speed);
    }
    if (std::isfinite(depth)) contacts.add_on_terrain(pose_ * point, edge_.normal, -depth);
  }

  const Surface& surface_;
  const SurfaceEdge& edge_;
  const Pose& pose_;
  int count_;
  const FaceAt& face_;
  Vec3 from_, to_;  ///< in the frame of the shape
  double begin_ = 0, end_ = 1;
  int begin_face_ = -1, end_face_ = -1;  ///< faces that cut it off; -1: it ends at a node
};

template <class FaceAt>
void add_ridges(const Surface& surface, const Pose& pose, const Aabb& box, int faces, const FaceAt& face,
                ContactCollector& contacts) {
  const Pose back = pose.inverse();
  surface.each_ridge(box, [&](const SurfaceEdge& edge) {
    RidgeInFaces<FaceAt>(surface, edge, pose, back, faces, face).add_to(contacts);
  });
}

}  // namespace

void add_box_contacts(const Surface& surface, const Vec3& size, const Pose& pose, const Aabb& box,
                      ContactCollector& contacts) {
  const Vec3 half = 0.5 * size;
  for (int i = 0; i < 8; ++i)
    add_corner(surface, pose * half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)), contacts);
  add_ridges(
      surface, pose, box, 6,
      [&](int i) {
        return Face{Vec3((i & 1 ? -1.0 : 1.0) * Vec3::Unit(i / 2)), half[i / 2]};
      },
      contacts);
}

void add_hull_contacts(const Surface& surface, const mesh::Hull& hull, const Pose& pose, const Aabb& box,
                       ContactCollector& contacts) {
  for (const Vec3& v : hull.vertices) add_corner(surface, pose * v, contacts);
  add_ridges(
      surface, pose, box, int(hull.faces.size()),
      [&](int i) {
        const mesh::Hull::Face& f = hull.faces[std::size_t(i)];
        return Face{f.normal, f.offset};
      },
      contacts);
}

}  // namespace muro::terrain_contact
