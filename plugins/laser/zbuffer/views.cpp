// SPDX-License-Identifier: MIT
#include "views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace muro::zbuffer {

namespace {

using std::numbers::pi;

/// rad between pixels, however few rays there are.
constexpr double coarsest = pi / 180;

/// The rays of one view.
struct Bin {
  Quat turn = Quat::Identity();  ///< from the view to the device
  std::vector<std::uint32_t> rays;
};

/// The azimuths that the rays use: from the first on, so far.
struct Span {
  double first = 0, wide = 0;
};

/// The shortest arc that holds all azimuths: what is left of the circle without the widest gap.
Span span_of(std::vector<double> azimuths) {
  if (azimuths.empty()) return {};
  std::sort(azimuths.begin(), azimuths.end());
  Span best{azimuths.front(), azimuths.back() - azimuths.front()};
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double wide = 2 * pi - (azimuths[i] - azimuths[i - 1]);
    if (wide < best.wide) best = {azimuths[i], wide};
  }
  return best;
}

std::vector<Bin> bins_of(const scanner::RaySet& rays) {
  std::vector<double> azimuths;
  for (const Vec3& d : rays.directions)
    if (std::asin(std::clamp(std::abs(d.z()), 0.0, 1.0)) <= Views::steepest)
      azimuths.push_back(std::atan2(d.y(), d.x()));
  const Span span = span_of(azimuths);
  const auto count = std::max<std::size_t>(1, std::size_t(std::ceil(span.wide / Views::widest - 1e-9)));
  const double wide = span.wide / double(count);
  std::vector<Bin> bins(count + 2);  // side by side, up, down
  for (std::size_t k = 0; k < count; ++k) bins[k].turn = from_rpy(0, 0, span.first + (double(k) + 0.5) * wide);
  bins[count].turn = from_rpy(0, -pi / 2, 0);
  bins[count + 1].turn = from_rpy(0, pi / 2, 0);
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const Vec3& d = rays.directions[i];
    std::size_t k = d.z() > 0 ? count : count + 1;
    if (std::asin(std::clamp(std::abs(d.z()), 0.0, 1.0)) <= Views::steepest) {
      double along = std::atan2(d.y(), d.x()) - span.first;
      while (along < -1e-9) along += 2 * pi;
      k = wide > 0 ? std::min(count - 1, std::size_t(std::max(0.0, along / wide))) : 0;
    }
    bins[k].rays.push_back(i);
  }
  std::erase_if(bins, [](const Bin& b) { return b.rays.empty(); });
  return bins;
}

/// What a view's rays take of the plane at distance 1.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  /// A view that is one pixel high or wide needs no neighbours.
  bool is_line() const { return high - low < 1e-9; }
};

/// Pixels along one side, and where the axis lies on it.
struct Side {
  std::uint32_t pixels = 1;
  double axis = 0;  ///< px, such that a place p on the plane is seen at axis - focal p
};

Side side_of(const Extent& e, double focal) {
  if (e.is_line()) return {1, 0.5 + focal * e.low};
  const double first = e.high * focal;  // the highest place has the first pixel
  const auto between = std::uint32_t(std::ceil((e.high - e.low) * focal - 1e-6));
  return {between + 1 + 2 * Views::margin, first + 0.5 + Views::margin};
}

}  // namespace

Views Views::of(const scanner::RaySet& rays, double pixels) {
  Views v;
  v.samples.resize(rays.size());
  const double focal = pixels / (rays.spacing > 0 ? std::min(rays.spacing, coarsest) : coarsest);
  for (const Bin& bin : bins_of(rays)) {
    Extent across, up;
    const auto seen = [&](std::uint32_t ray) { return bin.turn.conjugate() * rays.directions[ray]; };
    for (const std::uint32_t ray : bin.rays) {
      const Vec3 d = seen(ray);
      across.include(d.y() / d.x());
      up.include(d.z() / d.x());
    }
    const Side columns = side_of(across, focal), rows = side_of(up, focal);
    render::Camera c;
    c.pose.orientation = bin.turn;
    c.width = columns.pixels;
    c.height = rows.pixels;
    c.fx = c.fy = focal;
    c.cx = columns.axis;
    c.cy = rows.axis;
    for (const std::uint32_t ray : bin.rays) {
      const Vec3 d = seen(ray);
      v.samples[ray] = {std::uint32_t(v.cameras.size()), c.cx - focal * d.y() / d.x() - 0.5,
                        c.cy - focal * d.z() / d.x() - 0.5, 1 / d.x()};
    }
    v.cameras.push_back(c);
  }
  return v;
}

std::uint32_t Views::width() const {
  std::uint32_t most = 0;
  for (const render::Camera& c : cameras) most = std::max(most, c.width);
  return most;
}

std::uint32_t Views::height() const {
  std::uint32_t sum = 0;
  for (const render::Camera& c : cameras) sum += c.height;
  return sum;
}

}  // namespace muro::zbuffer
