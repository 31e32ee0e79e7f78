// SPDX-License-Identifier: MIT
#include "hull.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "muro/algorithm.hpp"

namespace muro::mesh {
namespace {

/// Owns what Qhull allocates.
class Run {
 public:
  Run(std::span<const Vec3> points, double tolerance) {
    qh_zero(&qh_, nullptr);
    for (const Vec3& p : points) numbers_.insert(numbers_.end(), p.data(), p.data() + 3);
    char command[64];
    std::snprintf(command, sizeof command, "qhull C-%.9g", tolerance);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere(std::fopen("/dev/null", "w"), std::fclose);
    failed_ = qh_new_qhull(&qh_, 3, int(points.size()), numbers_.data(), False, command, nullptr, nowhere.get()) != 0;
  }
  ~Run() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left = 0, more = 0;
    qh_memfreeshort(&qh_, &left, &more);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  bool failed() const { return failed_; }
  qhT* get() { return &qh_; }

 private:
  qhT qh_;
  std::vector<coordT> numbers_;
  bool failed_ = false;
};

}  // namespace

Hull convex_hull(std::span<const Vec3> points) {
  constexpr double coplanar = 1e-6;
  Aabb box;
  for (const Vec3& p : points) box.include({p, p});
  const double size = points.empty() ? 0 : (box.high - box.low).norm();
  Hull hull;
  if (points.size() >= 4 && size > 0) {
    Run run(points, coplanar * size);
    if (!run.failed()) {
      qhT* const qh = run.get();
      std::vector<std::int64_t> number(points.size(), -1);
      for (const facetT* f = qh->facet_list; f && f->next; f = f->next) {
        Hull::Face face;
        face.first = std::uint32_t(hull.corners.size());
        face.normal = Vec3(f->normal[0], f->normal[1], f->normal[2]);
        setT* around = qh_facet3vertex(qh, const_cast<facetT*>(f));
        const int count = qh_setsize(qh, around);
        face.count = std::uint32_t(count);
        face.offset = -std::numeric_limits<double>::infinity();
        for (int i = count; i-- > 0;) {  // they are in clockwise order
          const auto* const v = static_cast<const vertexT*>(SETelem_(around, i));
          const auto p = std::size_t(qh_pointid(qh, v->point));
          if (number[p] < 0) {
            number[p] = std::int64_t(hull.vertices.size());
            hull.vertices.push_back(points[p]);
          }
          hull.corners.push_back(std::uint32_t(number[p]));
          face.offset = std::max(face.offset, face.normal.dot(points[p]));
        }
        qh_settempfree(qh, &around);
        hull.faces.push_back(face);
      }
    }
  }
  if (hull.faces.empty())
    throw Error(std::to_string(points.size()) +
                " points have no convex hull with a volume: they lie in one plane, or hardly beside it");
  return hull;
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
