// SPDX-License-Identifier: MIT
// Embree: the scenery as quadrilaterals, vehicles as instances of one mesh. This is the fastest of the ways tried: the
// scenery in an instance of its own is slower to trace; one mesh of all vehicles is slower to update (rebuilt) or to
// trace (refitted); better builds of the top level cost more time than they save.
#include <embree3/rtcore.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "tests/bench/baselines/scanners.hpp"

namespace muro::bench {

namespace {

constexpr unsigned sides = 24;  // of the prism that represents a wheel

/// Corners, and the numbers of four corners for each quadrilateral.
struct Mesh {
  std::vector<float> corners;
  std::vector<unsigned> quads;

  unsigned size() const { return unsigned(corners.size() / 3); }
  void corner(const Vec3& p) {
    for (int k = 0; k < 3; ++k) corners.push_back(float(p[k]));
  }
  void quad(unsigned a, unsigned b, unsigned c, unsigned d) { quads.insert(quads.end(), {a, b, c, d}); }

  void box(const Vec3& centre, const Vec3& lengths) {
    const unsigned o = size();
    for (unsigned k = 0; k < 8; ++k)
      corner(centre + 0.5 * lengths.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
    quad(o, o + 1, o + 3, o + 2);
    quad(o + 4, o + 6, o + 7, o + 5);
    quad(o, o + 4, o + 5, o + 1);
    quad(o + 2, o + 3, o + 7, o + 6);
    quad(o, o + 2, o + 6, o + 4);
    quad(o + 1, o + 5, o + 7, o + 3);
  }
  /// Adds a wheel whose axis is y.
  void wheel(const Vec3& centre) {
    const unsigned o = size();
    for (const double side : {-0.5, 0.5})
      for (unsigned k = 0; k < sides; ++k) {
        const double a = 2 * M_PI * k / sides;
        corner(centre +
               Vec3(Rover::wheel_radius * std::cos(a), side * Rover::wheel_width, Rover::wheel_radius * std::sin(a)));
      }
    for (unsigned k = 0; k < sides; ++k) quad(o + k, o + (k + 1) % sides, o + sides + (k + 1) % sides, o + sides + k);
    for (const unsigned face : {o, o + sides})
      for (unsigned k = 1; k + 2 < sides; k += 2) quad(face, face + k, face + k + 1, face + k + 2);
  }
};

/// Frame and range of the rays of one call.
struct Beam {
  Vec3 origin;
  Mat3 axes;
  float range;
};

class EmbreeScanners final : public Scanners {
 public:
  EmbreeScanners(const City& city, const Pattern& pattern, double range, int width)
      : pattern_(pattern), range_(float(range)), width_(width), padded_((pattern.size() + 15) / 16 * 16) {
    for (std::vector<float>* v : {&pattern_.x, &pattern_.y, &pattern_.z}) v->resize(std::size_t(padded_), v->back());
    ranges_.resize(std::size_t(padded_) * std::size_t(city.vehicles()));
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
    Mesh scenery, rover;
    for (const Block& b : city.blocks()) scenery.box(b.centre, b.lengths);
    const unsigned o = scenery.size();
    for (const Vec3& p : {Vec3(-1e3, -1e3, 0), Vec3(1e3, -1e3, 0), Vec3(1e3, 1e3, 0), Vec3(-1e3, 1e3, 0)})
      scenery.corner(p);
    scenery.quad(o, o + 1, o + 2, o + 3);
    add(scene_, scenery);
    rover.box(Vec3::Zero(), {Rover::length, Rover::width, Rover::height});
    for (int w = 0; w < 4; ++w) rover.wheel(Rover::wheel_centre(w));
    rtcSetSceneBuildQuality(rover_, RTC_BUILD_QUALITY_HIGH);
    add(rover_, rover);
    rtcCommitScene(rover_);
    for (int v = 0; v < city.vehicles(); ++v) {
      vehicles_.push_back(rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE));
      rtcSetGeometryInstancedScene(vehicles_.back(), rover_);
      rtcCommitGeometry(vehicles_.back());
      rtcAttachGeometry(scene_, vehicles_.back());
    }
    rtcInitIntersectContext(&context_);
    context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  ~EmbreeScanners() override {
    for (const RTCGeometry g : vehicles_) rtcReleaseGeometry(g);
    rtcReleaseScene(scene_);
    rtcReleaseScene(rover_);
    rtcReleaseDevice(device_);
  }

  void scan(std::span<const Pose> poses, bool moved) override {
    if (moved) move(poses);
    for (std::size_t v = 0; v < poses.size(); ++v) {
      const Beam beam{poses[v] * Vec3(0, 0, scanner_height), poses[v].orientation.toRotationMatrix(), range_};
      float* out = ranges_.data() + v * std::size_t(padded_);
      if (width_ == 1) cast_singly(beam, out);
      if (width_ == 8) cast<RTCRayHit8, 8>(beam, out, &rtcIntersect8);
      if (width_ == 16) cast<RTCRayHit16, 16>(beam, out, &rtcIntersect16);
    }
  }
  double range(int vehicle, int ray) const override {
    return double(ranges_[std::size_t(vehicle) * std::size_t(padded_) + std::size_t(ray)]);
  }

 private:
  void add(RTCScene scene, const Mesh& mesh) {
    const RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    const std::size_t corner = 3 * sizeof(float), quad = 4 * sizeof(unsigned);
    std::memcpy(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, corner, mesh.size()),
                mesh.corners.data(), corner * mesh.size());
    std::memcpy(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, quad, mesh.quads.size() / 4),
                mesh.quads.data(), sizeof(unsigned) * mesh.quads.size());
    rtcSetGeometryBuildQuality(g, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene, g);
    rtcReleaseGeometry(g);
  }

  void move(std::span<const Pose> poses) {
    for (std::size_t v = 0; v < poses.size(); ++v) {
      const Mat3 axes = poses[v].orientation.toRotationMatrix();
      float columns[12];
      for (int k = 0; k < 9; ++k) columns[k] = float(axes(k % 3, k / 3));
      for (int k = 0; k < 3; ++k) columns[9 + k] = float(poses[v].position[k]);
      rtcSetGeometryTransform(vehicles_[v], 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
      rtcCommitGeometry(vehicles_[v]);
    }
    rtcCommitScene(scene_);
  }

  void cast_singly(const Beam& beam, float* out) {
    const Eigen::Matrix3f axes = beam.axes.cast<float>();
    const Eigen::Vector3f origin = beam.origin.cast<float>();
    for (int i = 0; i < pattern_.size(); ++i) {
      const std::size_t k = std::size_t(i);
      const Eigen::Vector3f d = axes * Eigen::Vector3f(pattern_.x[k], pattern_.y[k], pattern_.z[k]);
      RTCRayHit one;
      one.ray = {origin.x(), origin.y(), origin.z(), 0, d.x(), d.y(), d.z(), 0, beam.range, ~0u, 0, 0};
      one.hit.geomID = one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context_, &one);
      out[k] = one.ray.tfar;
    }
  }

  template <class Packet, int width>
  void cast(const Beam& beam, float* out, void (*intersect)(const int*, RTCScene, RTCIntersectContext*, Packet*)) {
    float m[9], origin[3];
    for (int k = 0; k < 9; ++k) m[k] = float(beam.axes(k / 3, k % 3));
    for (int k = 0; k < 3; ++k) origin[k] = float(beam.origin[k]);
    const int n = pattern_.size();
    for (int begin = 0; begin < n; begin += width) {
      const float *x = pattern_.x.data() + begin, *y = pattern_.y.data() + begin, *z = pattern_.z.data() + begin;
      Packet p;
      alignas(64) int valid[width];
      for (int i = 0; i < width; ++i) {
        valid[i] = begin + i < n ? -1 : 0;
        p.ray.org_x[i] = origin[0];
        p.ray.org_y[i] = origin[1];
        p.ray.org_z[i] = origin[2];
        p.ray.dir_x[i] = m[0] * x[i] + m[1] * y[i] + m[2] * z[i];
        p.ray.dir_y[i] = m[3] * x[i] + m[4] * y[i] + m[5] * z[i];
        p.ray.dir_z[i] = m[6] * x[i] + m[7] * y[i] + m[8] * z[i];
        p.ray.tnear[i] = p.ray.time[i] = 0;
        p.ray.tfar[i] = beam.range;
        p.ray.mask[i] = ~0u;
        p.ray.flags[i] = 0;
        p.hit.geomID[i] = p.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      intersect(valid, scene_, &context_, &p);
      std::memcpy(out + begin, p.ray.tfar, sizeof p.ray.tfar);
    }
  }

  Pattern pattern_;  ///< padded to whole packets
  float range_;
  int width_, padded_;
  std::vector<float> ranges_;
  RTCDevice device_ = rtcNewDevice("threads=1");
  RTCScene scene_ = rtcNewScene(device_), rover_ = rtcNewScene(device_);
  std::vector<RTCGeometry> vehicles_;
  RTCIntersectContext context_;
};

}  // namespace

std::unique_ptr<Scanners> embree_scanners(const City& city, const Pattern& pattern, double range, int width) {
  return std::make_unique<EmbreeScanners>(city, pattern, range, width);
}

}  // namespace muro::bench
