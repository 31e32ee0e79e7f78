// SPDX-License-Identifier: MIT
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "muro/base/elementary.hpp"

namespace muro::render {

using std::numbers::pi;

namespace {

constexpr double smooth_angle = 40 * pi / 180;
/// Limit of smoothing, which compares each with each: with more triangles at a vertex, normals are those of the
/// triangles.
constexpr std::size_t max_smooth_triangles = 1000;

Vertex vertex(const Vec3& position, const Vec3& normal, double across = 0, double down = 0) {
  return {{float(position.x()), float(position.y()), float(position.z())},
          {float(normal.x()), float(normal.y()), float(normal.z())},
          {float(across), float(down)}};
}

void add_quad(Surface& s, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  s.indices.insert(s.indices.end(), {a, b, c, a, c, d});
}

/// Makes a grid of a sphere's points between two latitudes (rad).
Surface part_of_sphere(int n, int rows, double low, double high) {
  Surface s;
  for (int i = 0; i <= rows; ++i) {
    const double latitude = low + (high - low) * i / rows;
    for (int k = 0; k <= n; ++k) {
      const double a = 2 * pi * (k % n) / n;
      const Vec3 p(elementary::cos(latitude) * elementary::cos(a), elementary::cos(latitude) * elementary::sin(a),
                   elementary::sin(latitude));
      s.vertices.push_back(vertex(p, p, double(k) / n, 0.5 - latitude / pi));
    }
  }
  const auto at = [&](int i, int k) { return std::uint32_t(i * (n + 1) + k); };
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < n; ++k) add_quad(s, at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
  return s;
}

}  // namespace

Surface unit_box() {
  Surface s;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      // textures are upright on the sides
      const Vec3 normal = 2 * side * Vec3::Unit(axis), v = Vec3::Unit(axis == 2 ? 1 : 2), u = v.cross(normal);
      const auto first = std::uint32_t(s.vertices.size());
      for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        s.vertices.push_back(vertex(0.5 * normal + x * u + y * v, normal, 0.5 + x, 0.5 - y));
      add_quad(s, first, first + 1, first + 2, first + 3);
    }
  return s;
}

Surface unit_sphere(int n) { return part_of_sphere(n, n / 2, -pi / 2, pi / 2); }
Surface unit_dome(int n) { return part_of_sphere(n, n / 4, 0, pi / 2); }

Surface unit_tube(int n) {
  Surface s;
  for (int k = 0; k <= n; ++k) {
    const double a = 2 * pi * (k % n) / n;
    const Vec3 out(elementary::cos(a), elementary::sin(a), 0);
    for (const double z : {-0.5, 0.5})
      s.vertices.push_back(vertex(out + z * Vec3::UnitZ(), out, double(k) / n, 0.5 - z));
  }
  for (std::uint32_t k = 0; k < std::uint32_t(n); ++k) add_quad(s, 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1);
  return s;
}

Surface unit_cylinder(int n) {
  Surface s = unit_tube(n);
  for (const double z : {-0.5, 0.5}) {
    const Vec3 normal = 2 * z * Vec3::UnitZ();
    const auto first = std::uint32_t(s.vertices.size());
    for (int k = 0; k < n; ++k) {
      const double a = (z > 0 ? 2 : -2) * pi * k / n;
      s.vertices.push_back(vertex(Vec3(elementary::cos(a), elementary::sin(a), z), normal,
                                  0.5 + 0.5 * elementary::cos(a), 0.5 - 0.5 * elementary::sin(a)));
    }
    for (std::uint32_t k = 1; k + 1 < std::uint32_t(n); ++k)
      s.indices.insert(s.indices.end(), {first, first + k, first + k + 1});
  }
  return s;
}

Surface unit_ground() {
  constexpr int rings = 7;
  Surface s;
  double half = 1;
  for (int ring = 0; ring <= rings; ++ring, half /= 4)
    for (const auto& [x, y] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
      s.vertices.push_back(vertex({x, y, 0}, Vec3::UnitZ()));
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const std::uint32_t outer = 4 * ring, inner = outer + 4;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      add_quad(s, outer + k, outer + next, inner + next, inner + k);
    }
  }
  add_quad(s, 4 * rings, 4 * rings + 1, 4 * rings + 2, 4 * rings + 3);
  return s;
}

Surface surface_of(const mesh::Mesh& mesh) {
  std::vector<Vec3> normals;  // of triangles, weighted by area
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  for (const mesh::Triangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t) around[corner].push_back(std::uint32_t(normals.size()));
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    normals.push_back(Vec3(b - a).cross(Vec3(c - a)));
  }
  const double smooth = elementary::cos(smooth_angle);
  Surface s;
  std::vector<std::vector<std::uint32_t>> drawn(mesh.vertices.size());  // vertices with their normals
  const auto index_of = [&](std::uint32_t corner, const Vec3& normal) {
    const Vertex v = vertex(mesh.vertices[corner], normal);
    if (around[corner].size() <= max_smooth_triangles)
      for (const std::uint32_t known : drawn[corner])
        if (s.vertices[known].normal == v.normal) return known;
    s.vertices.push_back(v);
    return drawn[corner].emplace_back(std::uint32_t(s.vertices.size() - 1));
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t corner : mesh.triangles[i]) {
      Vec3 sum = Vec3::Zero();
      if (around[corner].size() > max_smooth_triangles)
        sum = normals[i];
      else
        for (const std::uint32_t other : around[corner])
          if (normals[i].dot(normals[other]) >= smooth * normals[i].norm() * normals[other].norm())
            sum += normals[other];
      s.indices.push_back(index_of(corner, sum.normalized()));
    }
  return s;
}

Surface surface_of(const mesh::Submesh& part) {
  Surface s;
  for (const mesh::TexturedVertex& c : part.vertices)
    s.vertices.push_back(vertex(c.position, c.normal, c.texture_coordinates.x(), c.texture_coordinates.y()));
  for (const mesh::Triangle& t : part.triangles) s.indices.insert(s.indices.end(), t.begin(), t.end());
  return s;
}

int corners_for(double radius, double tolerance) {
  const double n = radius > tolerance ? pi / elementary::acos(1 - tolerance / radius) : 0;
  return 4 * int(std::ceil(std::clamp(n, 16.0, 512.0) / 4));
}

}  // namespace muro::render
