// SPDX-License-Identifier: MIT
// Rays over ground: the method of laser.raycast over a heightmap of 513 x 513 nodes, and Embree over the same
// triangles, with each of its calls, as triangles and as its grid geometry. All run alternately in one process.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "plugins/laser/common/raycast/ray_caster.hpp"
#include "plugins/laser/common/raycast/test_scene.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;
using raycast::RayPattern;
using scanner::Viewpoint;

constexpr std::uint32_t nodes = 513;
constexpr int turns = 15;

/// Returns the processor time of this thread (s), so that other programs do not count.
double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Hills of seven octaves, 200 x 200 m and 15 m high.
heightmap::HeightmapFile hills() {
  std::vector<float> values;
  for (std::uint32_t row = 0; row < nodes; ++row)
    for (std::uint32_t column = 0; column < nodes; ++column) {
      const double x = column / double(nodes - 1), y = row / double(nodes - 1);
      double z = 0, octave = 0.5;
      for (int k = 1; k < 128; k *= 2, octave *= 0.5)
        z += octave * std::sin(6.2 * k * x + k) * std::cos(5.7 * k * y + 2 * k);
      values.push_back(float(0.5 + 0.4 * z));
    }
  return heightmap::HeightmapFile::of(std::move(values), nodes, nodes);
}

class EmbreeGround {
 public:
  EmbreeGround(const Heightmap& map, bool as_grid) {
    const mesh::Mesh mesh = heightmap::mesh_of(map);
    const RTCGeometry g = rtcNewGeometry(device_, as_grid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *corner++ = float(v[k]);
    if (as_grid) {
      auto* grid = static_cast<RTCGrid*>(
          rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
      *grid = {0, map.columns, static_cast<unsigned short>(map.columns), static_cast<unsigned short>(map.rows)};
    } else {
      auto* number = static_cast<unsigned*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                    3 * sizeof(unsigned), mesh.triangles.size()));
      for (const mesh::Triangle& t : mesh.triangles) number = std::copy(t.begin(), t.end(), number);
    }
    rtcCommitGeometry(g);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene_);
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  ~EmbreeGround() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeGround(const EmbreeGround&) = delete;
  EmbreeGround& operator=(const EmbreeGround&) = delete;

  template <class Packet, int width, class Intersect>
  void cast(const Viewpoint& from, const std::vector<Eigen::Vector3f>& rays, std::vector<float>& ranges,
            Intersect intersect) {
    const Eigen::Matrix3f axes = from.device.orientation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f o = from.device.position.cast<float>();
    for (std::size_t begin = 0; begin < rays.size(); begin += width) {
      Packet p;
      alignas(64) int valid[width];
      for (std::size_t i = 0; i < width; ++i) {
        const Eigen::Vector3f d = axes * rays[std::min(begin + i, rays.size() - 1)];
        valid[i] = begin + i < rays.size() ? -1 : 0;
        p.ray.org_x[i] = o.x(), p.ray.org_y[i] = o.y(), p.ray.org_z[i] = o.z();
        p.ray.dir_x[i] = d.x(), p.ray.dir_y[i] = d.y(), p.ray.dir_z[i] = d.z();
        p.ray.tnear[i] = p.ray.time[i] = 0;
        p.ray.tfar[i] = float(from.max_range);
        p.ray.mask[i] = ~0u;
        p.ray.flags[i] = 0;
        p.hit.geomID[i] = p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      intersect(valid, scene_, &context_, &p);
      for (std::size_t i = 0; i < width && begin + i < rays.size(); ++i) ranges[begin + i] = p.ray.tfar[i];
    }
  }
  void cast_singly(const Viewpoint& from, const std::vector<Eigen::Vector3f>& rays, std::vector<float>& ranges) {
    const Eigen::Matrix3f axes = from.device.orientation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f o = from.device.position.cast<float>();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Eigen::Vector3f d = axes * rays[i];
      RTCRayHit one;
      one.ray = {o.x(), o.y(), o.z(), 0, d.x(), d.y(), d.z(), 0, float(from.max_range), ~0u, 0, 0};
      one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context_, &one);
      ranges[i] = one.ray.tfar;
    }
  }

 private:
  RTCDevice device_ = rtcNewDevice("threads=1");
  RTCScene scene_ = rtcNewScene(device_);
  RTCIntersectContext context_;
};

struct Case {
  const char* name;
  RayPattern pattern;
  double range;
};

/// Returns viewpoints 1.5 m above the ground, a little tilted.
std::vector<Viewpoint> viewpoints(const Heightmap& map, double range) {
  std::mt19937 dice(1);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  std::vector<Viewpoint> all;
  for (int i = 0; i < 8; ++i) {
    const double x = between(-80, 80), y = between(-80, 80);
    const Quat turn = from_rpy(between(-0.1, 0.1), between(-0.1, 0.1), between(-3, 3));
    all.push_back({{{x, y, map.ground_at(x, y)->height + 1.5}, turn}, range, -1, 0});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Report report("ground", "Rays over a heightmap: muro and Embree on the same triangles", argc, argv);
  const Shape shape{.kind = ShapeKind::heightmap, .mesh = TextId(1), .size = {200, 200, 15}};
  const heightmap::HeightmapFile file = hills();
  const Heightmap map = file.heightmap(shape.size);
  raycast::HeightTrees trees;
  trees.add(shape, file);
  raycast::test::TestScene scene;
  scene.add_scenery(shape, {});
  raycast::SceneTable table;
  table.build(scene.index(), trees);
  EmbreeGround triangles(map, false), grid(map, true);
  raycast::RayCaster caster;
  const raycast::ScanKernels& kernels = raycast::scan_kernels_for(lane::best_isa());

  report.table(fmt::format("Million rays per second over {} x {} nodes, one thread", nodes, nodes),
               {"rays", "laser.raycast", "Embree, 16 rays a call", "8", "1", "its grid, 16", "muro to Embree's best",
                "hits, %", "rays that differ, %"});
  const Case cases[] = {{"1024x64, 360 x 45 degrees, 100 m",
                         RayPattern(scanner::Grid{.min_angle = -M_PI,
                                                  .max_angle = M_PI,
                                                  .columns = 1024,
                                                  .min_elevation = -0.39,
                                                  .max_elevation = 0.39,
                                                  .rows = 64}),
                         100},
                        {"100x100, 60 x 60 degrees downward, 30 m",
                         RayPattern(scanner::Grid{.min_angle = -M_PI / 6,
                                                  .max_angle = M_PI / 6,
                                                  .columns = 100,
                                                  .min_elevation = -M_PI / 3,
                                                  .max_elevation = 0,
                                                  .rows = 100}),
                         30},
                        {"682x1, 240 degrees, 30 m",
                         RayPattern(scanner::Grid{.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682}), 30},
                        {"3600x1, 360 degrees, 100 m",
                         RayPattern(scanner::Grid{.min_angle = -M_PI, .max_angle = M_PI, .columns = 3600}), 100}};
  for (const Case& c : cases) {
    const std::size_t size = c.pattern.size();
    std::vector<Eigen::Vector3f> rays(size);
    for (const raycast::RayPacket& b : c.pattern.packets())
      for (std::uint32_t i = 0; i < b.count; ++i)
        rays[b.ray[i]] = Eigen::Vector3f(float(b.x[i]), float(b.y[i]), float(b.z[i]));
    const std::vector<Viewpoint> views = viewpoints(map, c.range);
    std::vector<double> ranges(size);
    std::vector<float> theirs(size);
    double best[5], hits = 0, differ = 0;
    std::fill(std::begin(best), std::end(best), 1e9);
    const auto time = [&](int which, const auto& cast) {
      const double start = now();
      int scans = 0;
      for (; scans == 0 || now() - start < 0.01;)
        for (const Viewpoint& from : views) cast(from), ++scans;
      best[which] = std::min(best[which], (now() - start) / scans);
    };
    for (const Viewpoint& from : views) {
      caster.cast(kernels, table, from, c.pattern, ranges, {});
      triangles.cast<RTCRayHit16, 16>(from, rays, theirs, &rtcIntersect16);
      for (std::size_t i = 0; i < size; ++i) {
        hits += ranges[i] < c.range;
        differ += std::abs(ranges[i] - double(theirs[i])) > 5e-3;
      }
    }
    for (int turn = 0; turn < turns; ++turn) {
      time(0, [&](const Viewpoint& v) { caster.cast(kernels, table, v, c.pattern, ranges, {}); });
      time(1, [&](const Viewpoint& v) { triangles.cast<RTCRayHit16, 16>(v, rays, theirs, &rtcIntersect16); });
      time(2, [&](const Viewpoint& v) { triangles.cast<RTCRayHit8, 8>(v, rays, theirs, &rtcIntersect8); });
      time(3, [&](const Viewpoint& v) { triangles.cast_singly(v, rays, theirs); });
      time(4, [&](const Viewpoint& v) { grid.cast<RTCRayHit16, 16>(v, rays, theirs, &rtcIntersect16); });
    }
    const double ratio = *std::min_element(best + 1, best + 5) / best[0], count = double(size * views.size());
    std::vector<Cell> row = {c.name};
    for (const double seconds : best) row.push_back(fixed(1e-6 * double(size) / seconds, 1));
    row.insert(row.end(), {fixed(ratio, 2), fixed(100 * hits / count, 1), fixed(100 * differ / count, 3)});
    report.row(row);
    report.ratio(std::string(c.name) + ": muro to Embree's best call", ratio, "at least 2");
  }
  report.note("Embree 3.13 is Debian's; it traces in single precision. The least time of 15 turns each.");
  report.finish();
  return 0;
}
