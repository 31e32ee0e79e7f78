// SPDX-License-Identifier: MIT
#include "hulls/hull_plane.hpp"

#include "lanes/ground.hpp"
#include "lanes/hull_points.hpp"
#include "plugins/common/contact_geometry/contact_refinement.hpp"

namespace muro::native {

void add_hull_on_plane(const KernelShape& hull, const Pose& body, const TransformedShape& plane,
                       std::vector<ContactPoint>& points) {
  const BodyFrame<double> frame({{body.position.data()}}, true);
  const std::size_t first = points.size();
  const auto add = [&](bool, const lane::V3<double>& point, double depth, int) {
    points.push_back({{point.x, point.y, point.z}, plane.axis(), depth});
  };
  lanes::give_hull_points<double>(hull, frame, ground_plane_of(plane), add);
  if (points.size() - first > max_ground_points) keep_outermost(points, first);
}

}  // namespace muro::native
