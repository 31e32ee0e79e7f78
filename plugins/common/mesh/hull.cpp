// SPDX-License-Identifier: MIT
#include "hull.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "muro/algorithm.hpp"

namespace muro::mesh {
namespace {

/// A computation of Qhull; owns its memory.
class QhullRun {
 public:
  QhullRun(std::span<const Vec3> points, double tolerance) {
    qh_zero(&qh_, nullptr);
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), p.data(), p.data() + 3);
    char command[64];
    std::snprintf(command, sizeof command, "qhull C-%.9g", tolerance);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> no_output(std::fopen("/dev/null", "w"), std::fclose);
    failed_ =
        qh_new_qhull(&qh_, 3, int(points.size()), coordinates_.data(), False, command, nullptr, no_output.get()) != 0;
  }
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left = 0, more = 0;
    qh_memfreeshort(&qh_, &left, &more);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool failed() const { return failed_; }
  qhT* get() { return &qh_; }

 private:
  qhT qh_;
  std::vector<coordT> coordinates_;
  bool failed_ = false;
};

/// Adds a facet with its vertices. `numbers`: by point, its number among the vertices of the hull; -1: not there yet.
void add_face(qhT* qh, facetT* facet, std::span<const Vec3> points, std::vector<std::int64_t>& numbers, Hull& hull) {
  Hull::Face face;
  face.first = std::uint32_t(hull.corners.size());
  face.normal = Vec3(facet->normal[0], facet->normal[1], facet->normal[2]);
  setT* vertices = qh_facet3vertex(qh, facet);
  const int count = qh_setsize(qh, vertices);
  face.count = std::uint32_t(count);
  face.offset = -std::numeric_limits<double>::infinity();
  for (int i = count; i-- > 0;) {  // Qhull has them in clockwise order
    const auto* const v = static_cast<const vertexT*>(SETelem_(vertices, i));
    const auto p = std::size_t(qh_pointid(qh, v->point));
    if (numbers[p] < 0) {
      numbers[p] = std::int64_t(hull.vertices.size());
      hull.vertices.push_back(points[p]);
    }
    hull.corners.push_back(std::uint32_t(numbers[p]));
    face.offset = std::max(face.offset, face.normal.dot(points[p]));
  }
  qh_settempfree(qh, &vertices);
  hull.faces.push_back(face);
}

}  // namespace

Hull convex_hull(std::span<const Vec3> points) {
  constexpr double coplanar = 1e-6;
  Aabb box;
  for (const Vec3& p : points) box.include({p, p});
  const double size = points.empty() ? 0 : (box.high - box.low).norm();
  Hull hull;
  if (points.size() >= 4 && size > 0) {
    QhullRun run(points, coplanar * size);
    std::vector<std::int64_t> numbers(points.size(), -1);
    if (!run.failed())
      for (facetT* f = run.get()->facet_list; f && f->next; f = f->next) add_face(run.get(), f, points, numbers, hull);
  }
  if (hull.faces.empty())
    throw Error(std::to_string(points.size()) +
                " points have no convex hull with a volume: they lie in one plane, or hardly beside it");
  return hull;
}

Hull hull_or_plate(std::span<const Vec3> points) {
  constexpr double thickness = 1e-3;
  Aabb box;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : points) {
    box.include({p, p});
    centre += p / double(points.size());
  }
  const double size = points.empty() ? 0 : (box.high - box.low).norm();
  Mat3 spread = Mat3::Zero();  // its axis of least spread is the normal of the plane
  for (const Vec3& p : points) spread += (p - centre) / size * ((p - centre) / size).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  const Vec3 normal = axes.eigenvectors().col(0);
  const auto height = [&](const Vec3& p) { return std::abs(normal.dot(p - centre)); };
  const bool is_flat =
      std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return height(p) < 0.1 * thickness * size; });
  if (!(size > 0) || !is_flat || axes.eigenvalues()[1] < 1e-6 * axes.eigenvalues()[2]) return convex_hull(points);
  std::vector<Vec3> plate;
  for (const Vec3& p : points)
    for (const double side : {-0.5, 0.5}) plate.push_back(p + side * thickness * size * normal);
  return convex_hull(plate);
}

Mesh surface_of(const Hull& hull) {
  Mesh m;
  m.vertices = hull.vertices;
  for (const Hull::Face& f : hull.faces) {
    const std::span<const std::uint32_t> c = hull.corners_of(f);
    for (std::size_t i = 2; i < c.size(); ++i) m.triangles.push_back({c[0], c[i - 1], c[i]});
  }
  return m;
}

}  // namespace muro::mesh
