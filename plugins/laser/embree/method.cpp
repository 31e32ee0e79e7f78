// SPDX-License-Identifier: MIT
#include "method.hpp"

#include <algorithm>
#include <cstddef>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/mesh.hpp"
#include "plugins/common/scanner/memory.hpp"

namespace muro::embree {

namespace {

constexpr unsigned wide = 16;  ///< rays in a call

}  // namespace

Embree::Embree() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
  // The top is built anew whenever something moves, so it has to be quick; meshes are built once.
  rtcSetSceneFlags(scene_, RTCSceneFlags(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
}

Embree::~Embree() {
  for (const auto& [name, scene] : meshes_) rtcReleaseScene(scene);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void Embree::connect(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    Solid s;
    s.object = ObjectId(i);
    if (c.robot_of(s.object) >= 0) continue;
    s.place = c.constant(s.object, keys::pose).value_or(Pose{});
    add_body(c, s.object, s);
  }
  for (const RobotView* robot : c.robots()) {
    if (c.constant(robot->base(), keys::shadow_of)) continue;
    for (const Link& f : robot->links) {
      Solid s;
      s.object = f.object;
      s.robot = std::int32_t(robot->number);
      add_body(c, f.object, s);
    }
  }
}

void Embree::add_body(Connector& c, ObjectId object, const Solid& of_body) {
  const std::span<const Shape> found = c.constant_array(object, keys::collision_shapes);
  const std::vector<Shape> shapes(found.begin(), found.end());
  if (shapes.empty()) return;
  Solid s = of_body;
  if (s.robot >= 0) s.body = c.read(object, keys::pose);
  for (const Shape& shape : shapes) {
    s.shape = shape;
    if (shape.kind == ShapeKind::plane) {
      planes_.push_back(s);
    } else if (shape.kind == ShapeKind::mesh) {
      Placed p{s, rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE)};
      rtcSetGeometryInstancedScene(p.instance, mesh(std::string(c.text(shape.mesh)), shape.size));
      rtcSetGeometryTimeStepCount(p.instance, 1);
      placed_.push_back(p);
    } else {
      (s.robot >= 0 ? moving_ : fixed_).push_back(s);
    }
  }
}

RTCScene Embree::mesh(const std::string& path, const Vec3& scale) {
  const auto [known, fresh] = meshes_.try_emplace({path, scale.x(), scale.y(), scale.z()}, nullptr);
  if (!fresh) return known->second;
  const mesh::Mesh m = mesh::load(path, scale);
  RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<float*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), m.vertices.size()));
  for (const Vec3& v : m.vertices)
    for (int k = 0; k < 3; ++k) *corners++ = float(v[k]);
  auto* triangles = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), m.triangles.size()));
  for (const mesh::Triangle& t : m.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
  rtcCommitGeometry(g);
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return known->second = scene;
}

void Embree::prepare(std::span<const scanner::RaySet> sets) { sets_.assign(sets.begin(), sets.end()); }

void Embree::place(const Placed& p) const {
  const Pose pose = p.solid.pose();
  const Mat3 turn = pose.orientation.toRotationMatrix();
  float columns[12];
  for (int k = 0; k < 4; ++k)
    for (int row = 0; row < 3; ++row) columns[3 * k + row] = float(k < 3 ? turn(row, k) : pose.position[row]);
  rtcSetGeometryTransform(p.instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(p.instance);
}

void Embree::start() {
  if (built_) return;
  scenery_.attach(device_, scene_, std::move(fixed_));
  robots_.attach(device_, scene_, std::move(moving_));
  for (const Placed& p : placed_) {
    place(p);
    const unsigned id = rtcAttachGeometry(scene_, p.instance);
    rtcReleaseGeometry(p.instance);  // the scene keeps it
    robot_of_.resize(std::max<std::size_t>(robot_of_.size(), id + 1), -1);
    object_of_.resize(robot_of_.size(), no_object);
    robot_of_[id] = p.solid.robot;
    object_of_[id] = p.solid.object;
  }
  built_ = true;
}

void Embree::look() {
  robots_.update();
  for (const Placed& p : placed_)
    if (p.solid.robot >= 0) place(p);
  for (Solid& s : planes_) s.update();
  rtcCommitScene(scene_);
}

/// Rays pass the robot that is not seen.
void Embree::skip_ignored(const RTCFilterFunctionNArguments* a) {
  const Rays& rays = *reinterpret_cast<const Rays*>(a->context);
  for (unsigned i = 0; i < a->N; ++i) {
    const unsigned instance = RTCHitN_instID(a->hit, a->N, i, 0);
    if (a->valid[i] == 0 || instance == RTC_INVALID_GEOMETRY_ID) continue;
    const std::int32_t robot = rays.robot_of_instance[instance];
    if (robot >= 0 && robot == rays.ignored_robot) a->valid[i] = 0;
  }
}

void Embree::cast(std::size_t set, const scanner::View& view, std::span<double> ranges, std::span<ObjectId> hits) {
  const bool exists = view.device.position.allFinite() && view.device.orientation.coeffs().allFinite();
  std::fill(ranges.begin(), ranges.end(), view.max_range);
  std::fill(hits.begin(), hits.end(), no_object);
  if (!exists) return;
  thread_local std::vector<Vec3> direction_memory;
  thread_local std::vector<ObjectId> object_memory;
  const scanner::RaySet& rays = sets_[set];
  Vec3* const directions = scanner::grown(direction_memory, rays.size()).data();
  ObjectId* const objects = hits.empty() ? scanner::grown(object_memory, rays.size()).data() : hits.data();
  const Mat3 turn = view.device.orientation.toRotationMatrix();
  for (std::uint32_t i = 0; i < rays.size(); ++i) directions[i] = turn * rays.directions[i];

  Rays call;
  rtcInitIntersectContext(&call.context);
  call.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  call.context.filter = skip_ignored;
  call.origin = view.device.position;
  call.directions = directions;
  call.ranges = ranges.data();
  call.objects = objects;
  call.ignored_robot = view.ignored_robot;
  call.robot_of_instance = robot_of_.data();
  for (std::uint32_t first = 0; first < rays.size(); first += wide) {
    RTCRayHit16 packet;
    alignas(64) int valid[wide];
    for (unsigned k = 0; k < wide; ++k) {
      const std::uint32_t i = std::min(first + k, rays.size() - 1);
      valid[k] = first + k < rays.size() ? -1 : 0;
      packet.ray.org_x[k] = float(call.origin.x());
      packet.ray.org_y[k] = float(call.origin.y());
      packet.ray.org_z[k] = float(call.origin.z());
      packet.ray.dir_x[k] = float(directions[i].x());
      packet.ray.dir_y[k] = float(directions[i].y());
      packet.ray.dir_z[k] = float(directions[i].z());
      packet.ray.tnear[k] = 0;
      packet.ray.tfar[k] = float(view.max_range);
      packet.ray.time[k] = 0;
      packet.ray.mask[k] = ~0U;
      packet.ray.id[k] = i;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene_, &call.context, &packet);
    for (unsigned k = 0; k < wide && first + k < rays.size(); ++k) {
      const unsigned instance = packet.hit.instID[0][k];
      const std::uint32_t i = first + k;
      if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID || instance == RTC_INVALID_GEOMETRY_ID) continue;
      if (!(double(packet.ray.tfar[k]) < ranges[i])) continue;
      ranges[i] = double(packet.ray.tfar[k]);
      objects[i] = object_of_[instance];
    }
  }
  for (const Solid& plane : planes_) {
    if (plane.robot >= 0 && plane.robot == view.ignored_robot) continue;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      const double distance = plane.distance(call.origin, directions[i]);
      if (distance < ranges[i]) ranges[i] = distance, objects[i] = plane.object;
    }
  }
  for (double& r : ranges) r = std::max(r, view.min_range);
}

}  // namespace muro::embree
