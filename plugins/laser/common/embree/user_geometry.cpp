// SPDX-License-Identifier: MIT
#include "user_geometry.hpp"

#include <cmath>
#include <limits>

#include "muro/base/bounds.hpp"
#include "muro/scene.hpp"
#include "plugins/laser/common/raycast/intersect.hpp"

namespace muro::embree {

namespace {

float rounded_down(double x) { return std::nextafter(float(x), -std::numeric_limits<float>::infinity()); }
float rounded_up(double x) { return std::nextafter(float(x), std::numeric_limits<float>::infinity()); }

}  // namespace

void BodyShape::update() {
  const Pose p = pose();
  position = p.position;
  to_shape = p.orientation.toRotationMatrix().transpose();
}

double BodyShape::distance(const Vec3& origin, const Vec3& direction) const {
  const Vec3 from = to_shape * Vec3(origin - position), along = to_shape * direction;
  const lane::V3<double> o{from.x(), from.y(), from.z()}, d{along.x(), along.y(), along.z()};
  const double r = shape.size.x(), half = 0.5 * shape.size.z();
  using namespace raycast::rays;
  switch (shape.kind) {
    case ShapeKind::box:
      return enter_box<double>(o, {1 / d.x, 1 / d.y, 1 / d.z}, 0.5 * shape.size.x(), 0.5 * shape.size.y(), half);
    case ShapeKind::sphere:
      return enter_ball(o, d, r);
    case ShapeKind::cylinder:
      return enter_cylinder(o, d, r, half);
    case ShapeKind::capsule:
      return enter_capsule(o, d, r, half);
    case ShapeKind::plane:
      return enter_half_space(o.z, d.z);
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
  return never;
}

void UserGeometry::attach(RTCDevice device, RTCScene scene, std::vector<BodyShape> shapes) {
  shapes_ = std::move(shapes);
  if (shapes_.empty()) return;
  for (BodyShape& s : shapes_) s.update();
  geometry_ = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry_, unsigned(shapes_.size()));
  rtcSetGeometryUserData(geometry_, this);
  rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry_, intersect);
  rtcCommitGeometry(geometry_);
  rtcAttachGeometry(scene, geometry_);
  rtcReleaseGeometry(geometry_);  // the scene keeps it
}

void UserGeometry::update() {
  if (shapes_.empty()) return;
  for (BodyShape& s : shapes_) s.update();
  rtcCommitGeometry(geometry_);
}

void UserGeometry::bounds(const RTCBoundsFunctionArguments* a) {
  const BodyShape& s = static_cast<const UserGeometry*>(a->geometryUserPtr)->shapes_[a->primID];
  const Aabb box = bounds_of(s.shape, s.pose());
  RTCBounds& out = *a->bounds_o;
  out.lower_x = rounded_down(box.low.x());
  out.lower_y = rounded_down(box.low.y());
  out.lower_z = rounded_down(box.low.z());
  out.upper_x = rounded_up(box.high.x());
  out.upper_y = rounded_up(box.high.y());
  out.upper_z = rounded_up(box.high.z());
}

void UserGeometry::intersect(const RTCIntersectFunctionNArguments* a) {
  const BodyShape& s = static_cast<const UserGeometry*>(a->geometryUserPtr)->shapes_[a->primID];
  const RayQuery& rays = *reinterpret_cast<const RayQuery*>(a->context);
  if (s.body.robot != no_robot && s.body.robot == rays.ignored_robot) return;
  RTCRayN* const ray = RTCRayHitN_RayN(a->rayhit, a->N);
  RTCHitN* const hit = RTCRayHitN_HitN(a->rayhit, a->N);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    const unsigned number = RTCRayN_id(ray, a->N, i);
    const double distance = s.distance(rays.origin, rays.directions[number]);
    if (!(distance < rays.ranges[number])) continue;
    rays.ranges[number] = distance;
    rays.objects[number] = s.body.object;
    RTCRayN_tfar(ray, a->N, i) = rounded_up(distance);
    RTCHitN_geomID(hit, a->N, i) = a->geomID;
    RTCHitN_primID(hit, a->N, i) = a->primID;
    RTCHitN_instID(hit, a->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace muro::embree
