// SPDX-License-Identifier: MIT
#include "solid.hpp"

namespace muro::mesh {

Inertia solid_inertia(const Mesh& surface, double density) {
  if (surface.vertices.empty()) return {};
  const Vec3 origin = surface.vertices[0];  // near the solid, so that the sums stay small
  double volume = 0;
  Vec3 first_moment = Vec3::Zero();
  Mat3 second_moment = Mat3::Zero();  // integral of x x^T
  for (const Triangle& t : surface.triangles) {
    const Vec3 a = surface.vertices[t[0]] - origin, b = surface.vertices[t[1]] - origin,
               c = surface.vertices[t[2]] - origin, sum = a + b + c;
    const double tetrahedron = a.cross(b).dot(c) / 6;
    volume += tetrahedron;
    first_moment += tetrahedron / 4 * sum;
    second_moment +=
        tetrahedron / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Vec3 centre = first_moment / volume;
  const Mat3 central = second_moment - volume * centre * centre.transpose();
  const Mat3 tensor = density * (central.trace() * Mat3::Identity() - central);
  return Inertia::from(density * volume, origin + centre, tensor);
}

}  // namespace muro::mesh
