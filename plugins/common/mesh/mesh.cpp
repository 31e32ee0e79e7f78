// SPDX-License-Identifier: MIT
#include "mesh.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace muro::mesh {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Returns for each vertex the first one that is equal to it.
std::vector<std::uint32_t> first_equal_vertices(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return before(vertices[a], vertices[b]) || (vertices[a] == vertices[b] && a < b);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && vertices[order[i]] == vertices[order[i - 1]] ? first[order[i - 1]] : order[i];
  return first;
}

bool has_area(const Mesh& m, const Triangle& t) {
  constexpr double min_ratio = 1e-14;  // of twice the area to the square of the longest side
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
  const Vec3 u = m.vertices[t[1]] - m.vertices[t[0]], v = m.vertices[t[2]] - m.vertices[t[0]];
  return u.cross(v).norm() > min_ratio * std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
}

}  // namespace

void clean(Mesh& m) {
  const std::vector<std::uint32_t> first = first_equal_vertices(m.vertices);
  for (Triangle& t : m.triangles)
    for (std::uint32_t& corner : t) corner = first[corner];
  std::erase_if(m.triangles, [&](const Triangle& t) { return !has_area(m, t); });
  std::vector<std::uint32_t> number(m.vertices.size(), none);
  std::vector<Vec3> used;
  for (Triangle& t : m.triangles)
    for (std::uint32_t& corner : t) {
      if (number[corner] == none) {
        number[corner] = std::uint32_t(used.size());
        used.push_back(m.vertices[corner]);
      }
      corner = number[corner];
    }
  m.vertices = std::move(used);
}

Aabb bounds_of(const Mesh& m) {
  Aabb box;
  for (const Vec3& v : m.vertices) box.include({v, v});
  return box;
}

bool is_closed(const Mesh& m) {
  std::vector<std::array<std::uint32_t, 2>> edges, reversed;
  for (const Triangle& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      edges.push_back({t[k], t[(k + 1) % 3]});
      reversed.push_back({t[(k + 1) % 3], t[k]});
    }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return !edges.empty() && edges == reversed && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

double volume_of(const Mesh& m) {
  if (m.vertices.empty()) return 0;
  double six_volumes = 0;
  const Vec3 origin = m.vertices[0];
  for (const Triangle& t : m.triangles)
    six_volumes +=
        (m.vertices[t[0]] - origin).cross(Vec3(m.vertices[t[1]] - origin)).dot(Vec3(m.vertices[t[2]] - origin));
  return six_volumes / 6;
}

bool is_convex(const Mesh& m, double tolerance) {
  if (!is_closed(m)) return false;
  const Aabb box = bounds_of(m);
  const double slack = tolerance * (box.high - box.low).norm();
  for (const Triangle& t : m.triangles) {
    const Vec3& at = m.vertices[t[0]];
    const Vec3 normal = (m.vertices[t[1]] - at).cross(Vec3(m.vertices[t[2]] - at)).normalized();
    for (const Vec3& v : m.vertices)
      if (normal.dot(v - at) > slack) return false;
  }
  return true;
}

}  // namespace muro::mesh
