// SPDX-License-Identifier: MIT
#include "exact_mesh.hpp"

#include <map>
#include <numeric>

#include "muro/base/elementary.hpp"

namespace muro::contact_geometry {
namespace {

constexpr double slack = 0.01;  ///< rad
constexpr double rim = M_PI;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

}  // namespace

ExactMesh::ExactMesh(const mesh::Mesh& surface) : surface_(&surface), closed_(mesh::is_closed(surface)) {
  std::map<Edge, std::size_t> triangle_of;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) triangle_of[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] = t;
  std::vector<Aabb> boxes;
  for (const mesh::Triangle& t : surface.triangles) {
    Triangle& s = triangles_.emplace_back();
    const Vec3 &a = surface.vertices[t[0]], &b = surface.vertices[t[1]], &c = surface.vertices[t[2]];
    s.normal = (b - a).cross(Vec3(c - a)).normalized();
    Aabb& box = boxes.emplace_back();
    for (const Vec3& corner : {a, b, c}) box.include({corner, corner});
  }
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0U);
  tree_.build(boxes, all);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const mesh::Triangle& t = surface.triangles[i];
    Triangle& s = triangles_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 along = (surface.vertices[t[(k + 1) % 3]] - surface.vertices[t[k]]).normalized();
      s.edge_normals[k] = along.cross(s.normal);
      const auto neighbour = triangle_of.find({t[(k + 1) % 3], t[k]});
      if (neighbour == triangle_of.end()) {
        s.max_lean[k] = rim;
      } else {
        const Vec3& n = triangles_[neighbour->second].normal;
        s.max_lean[k] = elementary::atan2(n.dot(s.edge_normals[k]), n.dot(s.normal));
      }
    }
  }
}

std::int64_t ExactMesh::triangle_at(const Vec3& point, double reach) const {
  std::int64_t best = -1;
  double nearest = reach;
  const Vec3 margin = Vec3::Constant(reach);
  each_near({point - margin, point + margin}, [&](std::uint32_t i) {
    const Triangle& s = triangles_[i];
    const mesh::Triangle& t = surface_->triangles[i];
    const double height = std::abs(s.normal.dot(point - surface_->vertices[t[0]]));
    for (std::size_t k = 0; k < 3; ++k)
      if (s.edge_normals[k].dot(point - surface_->vertices[t[k]]) > 1e-3 * reach) return;
    if (height > nearest || (height == nearest && best >= 0 && best < std::int64_t(i))) return;
    nearest = height, best = std::int64_t(i);
  });
  return best;
}

bool ExactMesh::allows(std::size_t triangle, const Vec3& n) const {
  const Triangle& s = triangles_[triangle];
  const double up = n.dot(s.normal), side = up < 0 ? -1 : 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double limit = s.max_lean[k] == rim ? rim : std::max(0.0, side * s.max_lean[k]);
    if (elementary::atan2(n.dot(s.edge_normals[k]), std::abs(up)) > limit + slack) return false;
  }
  return true;
}

Feature ExactMesh::face(std::size_t triangle, const Pose& pose, const Vec3& seen_from) const {
  const mesh::Triangle& t = surface_->triangles[triangle];
  Feature f;
  f.count = 4;
  for (std::size_t k = 0; k < 3; ++k) f.points[k] = pose * surface_->vertices[t[k]];
  f.points[3] = 0.5 * (f.points[0] + f.points[2]);
  f.centre = (f.points[0] + f.points[1] + f.points[2]) / 3;
  f.support = f.centre;
  f.normal = pose.orientation * triangles_[triangle].normal;
  if (!closed_ && f.normal.dot(seen_from - f.centre) < 0) f.normal = -f.normal;
  return f;
}

}  // namespace muro::contact_geometry
