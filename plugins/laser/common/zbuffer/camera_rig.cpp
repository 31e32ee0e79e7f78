// SPDX-License-Identifier: MIT
#include "camera_rig.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "muro/base/elementary.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::zbuffer {

namespace {

using std::numbers::pi;

/// Greatest angle between pixels, rad, even for few rays.
constexpr double max_spacing = pi / 180;

/// The rays of one camera.
struct CameraRays {
  Quat orientation = Quat::Identity();  ///< from the camera to the device
  std::vector<std::uint32_t> rays;
};

/// The arc of azimuths of the rays, rad.
struct AzimuthSpan {
  double first = 0, width = 0;
};

/// Returns the shortest arc that contains all azimuths: the circle without its widest gap.
AzimuthSpan span_of(std::vector<double> azimuths) {
  if (azimuths.empty()) return {};
  std::sort(azimuths.begin(), azimuths.end());
  AzimuthSpan best{azimuths.front(), azimuths.back() - azimuths.front()};
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double width = 2 * pi - (azimuths[i] - azimuths[i - 1]);
    if (width < best.width) best = {azimuths[i], width};
  }
  return best;
}

std::vector<CameraRays> rays_by_camera(const scanner::RaySet& rays) {
  std::vector<double> azimuths;
  for (const Vec3& d : rays.directions)
    if (elementary::asin(std::clamp(std::abs(d.z()), 0.0, 1.0)) <= CameraRig::max_elevation)
      azimuths.push_back(elementary::atan2(d.y(), d.x()));
  const AzimuthSpan span = span_of(azimuths);
  const auto count = std::max<std::size_t>(1, std::size_t(std::ceil(span.width / CameraRig::max_width - 1e-9)));
  const double width = span.width / double(count);
  std::vector<CameraRays> cameras(count + 2);  // side by side, up, down
  for (std::size_t k = 0; k < count; ++k)
    cameras[k].orientation = from_rpy(0, 0, span.first + (double(k) + 0.5) * width);
  cameras[count].orientation = from_rpy(0, -pi / 2, 0);
  cameras[count + 1].orientation = from_rpy(0, pi / 2, 0);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Vec3& d = rays.directions[i];
    std::size_t k = d.z() > 0 ? count : count + 1;
    if (elementary::asin(std::clamp(std::abs(d.z()), 0.0, 1.0)) <= CameraRig::max_elevation) {
      double along = elementary::atan2(d.y(), d.x()) - span.first;
      while (along < -1e-9) along += 2 * pi;
      k = width > 0 ? std::min(count - 1, std::size_t(std::max(0.0, along / width))) : 0;
    }
    cameras[k].rays.push_back(i);
  }
  std::erase_if(cameras, [](const CameraRays& b) { return b.rays.empty(); });
  return cameras;
}

/// The part of the plane at distance 1 that the rays of a camera cover, along one side.
struct PlaneInterval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// Whether the image is one pixel high or wide: then it needs no neighbours.
  bool is_line() const { return high - low < 1e-9; }
};

/// Number of pixels along one side, and the position of the axis on it.
struct Side {
  std::uint32_t pixels = 1;
  double axis = 0;  ///< px; a point p of the plane is seen at axis - focal p
};

Side side_of(const PlaneInterval& e, double focal) {
  if (e.is_line()) return {1, 0.5 + focal * e.low};
  const double first = e.high * focal;  // the highest point is in the first pixel
  constexpr double too_many = 1e9;      // so many pixels are refused later
  const auto between = std::uint32_t(std::ceil(std::min((e.high - e.low) * focal - 1e-6, too_many)));
  return {between + 1 + 2 * CameraRig::margin, first + 0.5 + CameraRig::margin};
}

}  // namespace

CameraRig CameraRig::of(const scanner::RaySet& rays, double pixels) {
  CameraRig rig;
  rig.samples.resize(rays.size());
  const double focal = pixels / (rays.spacing > 0 ? std::min(rays.spacing, max_spacing) : max_spacing);
  for (const CameraRays& camera : rays_by_camera(rays)) {
    PlaneInterval across, up;
    const auto in_camera = [&](std::uint32_t ray) { return camera.orientation.conjugate() * rays.directions[ray]; };
    for (const std::uint32_t ray : camera.rays) {
      const Vec3 d = in_camera(ray);
      across.include(d.y() / d.x());
      up.include(d.z() / d.x());
    }
    const Side columns = side_of(across, focal), rows = side_of(up, focal);
    render::Camera c;
    c.pose.orientation = camera.orientation;
    c.width = columns.pixels;
    c.height = rows.pixels;
    c.fx = c.fy = focal;
    c.cx = columns.axis;
    c.cy = rows.axis;
    for (const std::uint32_t ray : camera.rays) {
      const Vec3 d = in_camera(ray);
      rig.samples[ray] = {std::uint32_t(rig.cameras.size()), c.cx - focal * d.y() / d.x() - 0.5,
                          c.cy - focal * d.z() / d.x() - 0.5, 1 / d.x()};
    }
    rig.cameras.push_back(c);
  }
  return rig;
}

std::uint32_t CameraRig::width() const {
  std::uint32_t max = 0;
  for (const render::Camera& c : cameras) max = std::max(max, c.width);
  return max;
}

std::uint32_t CameraRig::height() const {
  std::uint32_t sum = 0;
  for (const render::Camera& c : cameras) sum += c.height;
  return sum;
}

}  // namespace muro::zbuffer
