// SPDX-License-Identifier: MIT
#include "embree_method.hpp"

#include <algorithm>
#include <cstddef>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/heightmap/solid.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/mesh/mesh.hpp"
#include "plugins/laser/common/scanner/scratch.hpp"

namespace muro::embree {

namespace {

constexpr unsigned packet_size = 16;  ///< rays in a call of Embree

}  // namespace

Embree::Embree() : device_(rtcNewDevice("threads=1")) {
  if (!device_)
    throw Error("Embree cannot be started: error " + std::to_string(int(rtcGetDeviceError(nullptr))) +
                "; use laser.raycast, which needs no library");
  rtcSetDeviceErrorFunction(device_, &keep_error, this);
  scene_ = rtcNewScene(device_);
  // The top level is rebuilt whenever something moves, so its build must be fast; meshes are built once.
  rtcSetSceneFlags(scene_, RTCSceneFlags(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
}

Embree::~Embree() {
  for (const auto& [name, scene] : meshes_)
    if (scene) rtcReleaseScene(scene);
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void Embree::keep_error(void* self, RTCError code, const char* text) noexcept {
  Embree& embree = *static_cast<Embree*>(self);
  const std::lock_guard lock(embree.mutex_);
  if (embree.has_failed_) return;
  embree.error_ = code == RTC_ERROR_OUT_OF_MEMORY ? "there is not enough memory for its trees"
                                                  : "error " + std::to_string(int(code));
  if (text) embree.error_ += " (" + std::string(text) + ")";
  embree.has_failed_ = true;
}

void Embree::check() const {
  if (!has_failed_) return;
  const std::lock_guard lock(mutex_);
  throw Error("Embree: " + error_ + "; make meshes smaller, or use laser.raycast");
}

void Embree::connect(Connector& c) {
  const auto shapes_of = [&](ObjectId object) { return c.constant_array(object, keys::collision_shapes); };
  const auto add_all = [&](const scene_bodies::SceneBody& body, Rows<Shape> shapes) {
    for (const Shape& shape : shapes) add(c, {.shape = shape, .body = body});
  };
  scene_bodies::for_each_body(c, shapes_of, add_all);
  check();
}

void Embree::add(Connector& c, const BodyShape& s) {
  if (s.shape.kind == ShapeKind::plane) {
    planes_.push_back(s);
  } else if (s.shape.kind == ShapeKind::mesh || s.shape.kind == ShapeKind::heightmap) {
    RTCScene scene = mesh(c, s);
    if (!scene) return;
    MeshInstance instance{s, rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE)};
    rtcSetGeometryInstancedScene(instance.geometry, scene);
    rtcSetGeometryTimeStepCount(instance.geometry, 1);
    mesh_instances_.push_back(instance);
    if (s.shape.kind == ShapeKind::mesh) return;
    heightmap_shapes_.push_back(s);
    heightmap_surfaces_.push_back(heightmaps_.file(std::string(c.text(s.shape.mesh))).heightmap(s.shape.size));
  } else {
    (s.body.robot != no_robot ? robot_shapes_ : scenery_shapes_).push_back(s);
  }
}

RTCScene Embree::mesh(Connector& c, const BodyShape& s) {
  const std::string path(c.text(s.shape.mesh));
  const Vec3& scale = s.shape.size;
  const auto [entry, is_new] = meshes_.try_emplace({path, scale.x(), scale.y(), scale.z()}, nullptr);
  if (!is_new) return entry->second;
  mesh::Mesh m;
  try {
    if (s.shape.kind == ShapeKind::mesh)
      m = mesh::load(path, scale);
    else
      m = heightmap::solid_mesh_of(heightmaps_.file(path).heightmap(scale));
  } catch (const Error& error) {
    mesh::refuse_collision_mesh(c, s.body.object, error);
    return nullptr;
  }
  return entry->second = build(m);
}

RTCScene Embree::build(const mesh::Mesh& m) {
  RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corners = static_cast<float*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), m.vertices.size()));
  check();
  for (const Vec3& v : m.vertices)
    for (int k = 0; k < 3; ++k) *corners++ = float(v[k]);
  auto* triangles = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), m.triangles.size()));
  check();
  for (const mesh::Triangle& t : m.triangles) triangles = std::copy(t.begin(), t.end(), triangles);
  rtcCommitGeometry(g);
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return scene;
}

void Embree::prepare(std::span<const scanner::RaySet> sets) { sets_.assign(sets.begin(), sets.end()); }

void Embree::place(const MeshInstance& instance) const {
  const Pose pose = instance.shape.pose();
  const Mat3 rotation = pose.orientation.toRotationMatrix();
  float columns[12];
  for (int k = 0; k < 4; ++k)
    for (int row = 0; row < 3; ++row) columns[3 * k + row] = float(k < 3 ? rotation(row, k) : pose.position[row]);
  rtcSetGeometryTransform(instance.geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  rtcCommitGeometry(instance.geometry);
}

void Embree::start() {
  if (is_built_) return;
  scenery_.attach(device_, scene_, std::move(scenery_shapes_));
  robots_.attach(device_, scene_, std::move(robot_shapes_));
  for (const MeshInstance& instance : mesh_instances_) {
    place(instance);
    const unsigned id = rtcAttachGeometry(scene_, instance.geometry);
    rtcReleaseGeometry(instance.geometry);  // the scene keeps it
    robot_of_.resize(std::max<std::size_t>(robot_of_.size(), id + 1), no_robot);
    object_of_.resize(robot_of_.size(), no_object);
    robot_of_[id] = instance.shape.body.robot;
    object_of_[id] = instance.shape.body.object;
  }
  is_built_ = true;
  check();
}

void Embree::update() {
  robots_.update();
  for (const MeshInstance& instance : mesh_instances_)
    if (instance.shape.body.robot != no_robot) place(instance);
  for (BodyShape& plane : planes_) plane.update();
  rtcCommitScene(scene_);
  check();
}

/// Lets rays pass through the robot that is not seen.
void Embree::skip_ignored_robot(const RTCFilterFunctionNArguments* a) {
  const RayQuery& query = *reinterpret_cast<const RayQuery*>(a->context);
  for (unsigned i = 0; i < a->N; ++i) {
    const unsigned instance = RTCHitN_instID(a->hit, a->N, i, 0);
    if (a->valid[i] == 0 || instance == RTC_INVALID_GEOMETRY_ID) continue;
    const RobotId robot = query.robot_of_instance[instance];
    if (robot != no_robot && robot == query.ignored_robot) a->valid[i] = 0;
  }
}

void Embree::intersect_scene(RayQuery& query, std::uint32_t count, double max_range) const {
  for (std::uint32_t first = 0; first < count; first += packet_size) {
    RTCRayHit16 packet;
    alignas(64) int valid[packet_size];
    for (unsigned k = 0; k < packet_size; ++k) {
      const std::uint32_t i = std::min(first + k, count - 1);
      valid[k] = first + k < count ? -1 : 0;
      packet.ray.org_x[k] = float(query.origin.x());
      packet.ray.org_y[k] = float(query.origin.y());
      packet.ray.org_z[k] = float(query.origin.z());
      packet.ray.dir_x[k] = float(query.directions[i].x());
      packet.ray.dir_y[k] = float(query.directions[i].y());
      packet.ray.dir_z[k] = float(query.directions[i].z());
      packet.ray.tnear[k] = 0;
      packet.ray.tfar[k] = float(max_range);
      packet.ray.time[k] = 0;
      packet.ray.mask[k] = ~0U;
      packet.ray.id[k] = i;
      packet.ray.flags[k] = 0;
      packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene_, &query.context, &packet);
    for (unsigned k = 0; k < packet_size && first + k < count; ++k) {
      const unsigned instance = packet.hit.instID[0][k];
      const std::uint32_t i = first + k;
      if (packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID || instance == RTC_INVALID_GEOMETRY_ID) continue;
      if (!(double(packet.ray.tfar[k]) < query.ranges[i])) continue;
      query.ranges[i] = double(packet.ray.tfar[k]);
      query.objects[i] = object_of_[instance];
    }
  }
}

void Embree::intersect_planes(const RayQuery& query, std::uint32_t count) const {
  for (const BodyShape& plane : planes_) {
    if (plane.body.robot != no_robot && plane.body.robot == query.ignored_robot) continue;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double distance = plane.distance(query.origin, query.directions[i]);
      if (distance < query.ranges[i]) query.ranges[i] = distance, query.objects[i] = plane.body.object;
    }
  }
}

ObjectId Embree::ground_around(const Vec3& point) const {
  for (std::size_t i = 0; i < heightmap_shapes_.size(); ++i)
    if (heightmap::contains(heightmap_surfaces_[i], heightmap_shapes_[i].pose().inverse() * point))
      return heightmap_shapes_[i].body.object;
  return no_object;
}

void Embree::cast(std::size_t set, const scanner::Viewpoint& from, std::span<double> ranges, std::span<ObjectId> hits) {
  std::fill(ranges.begin(), ranges.end(), from.max_range);
  std::fill(hits.begin(), hits.end(), no_object);
  if (!from.device.position.allFinite() || !from.device.orientation.coeffs().allFinite()) return;
  if (const ObjectId ground = ground_around(from.device.position); ground != no_object) {
    std::fill(ranges.begin(), ranges.end(), from.min_range);
    std::fill(hits.begin(), hits.end(), ground);
    return;
  }
  thread_local std::vector<Vec3> direction_memory;
  thread_local std::vector<ObjectId> object_memory;
  const scanner::RaySet& rays = sets_[set];
  const std::span<Vec3> directions = scanner::scratch(direction_memory, rays.size());
  const Mat3 rotation = from.device.orientation.toRotationMatrix();
  for (std::uint32_t i = 0; i < rays.size(); ++i) directions[i] = rotation * rays.directions[i];

  RayQuery query;
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  query.context.filter = skip_ignored_robot;
  query.origin = from.device.position;
  query.directions = directions.data();
  query.ranges = ranges.data();
  query.objects = hits.empty() ? scanner::scratch(object_memory, rays.size()).data() : hits.data();
  query.ignored_robot = from.ignored_robot;
  query.robot_of_instance = robot_of_.data();
  intersect_scene(query, rays.size(), from.max_range);
  intersect_planes(query, rays.size());
  for (double& r : ranges) r = std::max(r, from.min_range);
  check();
}

}  // namespace muro::embree
