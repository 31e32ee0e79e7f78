// SPDX-License-Identifier: MIT
// Separating axes of two boxes (Gottschalk, Lin, Manocha: OBBTree, SIGGRAPH 1996): six faces, nine pairs of edges. Then
// the two faces that are opposite each other are clipped.
#include "pairs/collide.hpp"
#include "plugins/common/contact_geometry/feature.hpp"

namespace muro::native {

void box_box(const TransformedShape& a, const TransformedShape& b, Manifold& out) {
  const Vec3 d = b.centre - a.centre;
  const Mat3 r = a.axes.transpose() * b.axes, size = r.cwiseAbs();
  const Vec3 da = a.axes.transpose() * d;
  const Vec3 over_a = a.half + size * b.half - da.cwiseAbs();
  if (over_a.minCoeff() <= 0) return;
  const Vec3 db = b.axes.transpose() * d;
  const Vec3 over_b = b.half + size.transpose() * a.half - db.cwiseAbs();
  if (over_b.minCoeff() <= 0) return;

  // If depths are equal, a face is preferred to edges, and a face of the first shape to one of the second.
  const double bias = 1 - 1e-9;
  int face;
  double depth = over_a.minCoeff(&face);
  Vec3 normal = a.axes.col(face);
  int face_b;
  if (over_b.minCoeff(&face_b) < bias * depth) {
    depth = over_b[face_b];
    normal = b.axes.col(face_b);
  }
  int edge_a = -1, edge_b = -1;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const double sine2 = 1 - r(i, j) * r(i, j);
      if (sine2 < 1e-10) continue;  // parallel: a face separates at least as well
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach = a.half[i1] * size(i2, j) + a.half[i2] * size(i1, j) +  //
                           b.half[j1] * size(i, j2) + b.half[j2] * size(i, j1);
      const double over = reach - std::abs(da[i2] * r(i1, j) - da[i1] * r(i2, j));
      if (over <= 0) return;
      if (over * over >= bias * bias * depth * depth * sine2) continue;
      depth = over / std::sqrt(sine2);
      edge_a = i, edge_b = j;
    }
  }
  if (edge_a >= 0) normal = a.axes.col(edge_a).cross(b.axes.col(edge_b)).normalized();
  if (normal.dot(d) > 0) normal = -normal;
  add_patch(feature_towards(a, -normal), feature_towards(b, normal), normal, depth, out);
}

}  // namespace muro::native
