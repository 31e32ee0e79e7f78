// SPDX-License-Identifier: MIT
#include "method.hpp"

#include <algorithm>
#include <string>

#include "muro/algorithm.hpp"

namespace muro::zbuffer {

namespace {

constexpr double chord = 2e-4;  ///< m: how far circles lie inside of themselves
/// m along the axis of a picture. What is nearer than this is not drawn; the precision of depths does not depend on it.
constexpr double near_plane = 1e-3;
constexpr std::uint32_t most_pixels = 8192;  ///< along a side, which every OpenGL 4.5 can draw

Extent extent_of(const render::Camera& c) {
  if (c.width == 1) return c.height == 1 ? Extent::point : Extent::upright;
  return c.height == 1 ? Extent::level : Extent::whole;
}

}  // namespace

ZBuffer::~ZBuffer() {
  if (!context_) return;
  const render::Current current(*context_);
  distances_.reset();
  labelled_.reset();
  renderer_.reset();
  stage_.reset();
}

void ZBuffer::connect(Connector& c) {
  supersampling_ = c.parameters().real(supersampling.name);
  device_ = render::device_of(c.parameters());
  host_ = &c.host();
  scene_.connect(c, render::Look::as_collides, chord);
}

void ZBuffer::prepare(std::span<const scanner::RaySet> sets) {
  for (const scanner::RaySet& set : sets) {
    Picture p;
    p.views = Views::of(set, supersampling_);
    p.columns = set.rows > 1 ? set.columns : 0;
    const std::uint32_t width = p.views.width();
    for (render::Camera& camera : p.views.cameras) {
      camera.near = near_plane;
      p.tops.push_back(p.height);
      p.height += camera.height;
    }
    if (width > most_pixels || p.height > most_pixels)
      throw Error("the z-buffer would need " + std::to_string(width) + " x " + std::to_string(p.height) +
                  " pixels; at most " + std::to_string(most_pixels) +
                  " either way are possible: take fewer rays, less supersampling, or laser.raycast");
    width_ = std::max(width_, width);
    height_ = std::max(height_, p.height);
    pictures_.push_back(std::move(p));
  }
  for (Picture& p : pictures_) place_samples(p);
}

/// Once it is known how wide the buffer is.
void ZBuffer::place_samples(Picture& p) const {
  p.resampling.resize(p.views.cameras.size());
  const auto whole = [](double x) { return std::int32_t(std::max(x, 0.0)); };
  const auto stride = std::int32_t(width_);
  // rays of one column of a view have one column of pixels between them
  std::vector<std::int32_t> column_of(p.columns);
  for (std::uint32_t view = 0; view < p.resampling.size(); ++view) {
    Picture::Resampling& r = p.resampling[view];
    std::vector<std::uint32_t> rays;
    for (std::uint32_t ray = 0; ray < p.views.samples.size(); ++ray)
      if (p.views.samples[ray].view == view) rays.push_back(ray);
    std::fill(column_of.begin(), column_of.end(), -1);
    std::vector<double> places;
    bool upright = p.columns > 0 && p.views.cameras[view].height > 1 && p.views.cameras[view].width > 1;
    for (std::size_t i = 0; i < rays.size() && upright; ++i) {
      const double place = p.views.samples[rays[i]].column;
      std::int32_t& number = column_of[rays[i] % p.columns];
      if (number < 0) {
        number = std::int32_t(places.size());
        places.push_back(place);
        r.columns.add(0, whole(place), float(place - whole(place)), 0, 0, 0);
      }
      upright = std::abs(places[std::size_t(number)] - place) < 1e-6;
    }
    if (!upright) r.columns = {};
    if (upright) r.columns.fill();
    for (const std::uint32_t ray : rays) {
      const Sample& s = p.views.samples[ray];
      const std::int32_t column = whole(s.column), row = whole(s.row), top = std::int32_t(p.tops[view]);
      const std::int32_t nearest = (top + whole(s.row + 0.5)) * stride + whole(s.column + 0.5);
      const std::int32_t pixel =
          upright ? row * std::int32_t(r.columns.room()) + column_of[ray % p.columns] : (top + row) * stride + column;
      r.samples.add(ray, pixel, float(s.column - column), float(s.row - row), s.per_depth, nearest);
    }
    r.samples.fill();
  }
}

void ZBuffer::start() {
  moved_ = true;
  if (context_) return;
  context_.emplace(device_);
  host_->log(LogLevel::info, "the z-buffer of lasers is drawn by " + context_->renderer());
}

void ZBuffer::look() { moved_ = true; }

void ZBuffer::draw(const Picture& picture, const scanner::View& view, bool labels) {
  const render::Current current(*context_);
  if (!stage_) {
    stage_.emplace(scene_);
    renderer_.emplace(*stage_);
  }
  if (moved_) stage_->place();
  moved_ = false;
  std::optional<render::DepthTarget>& target = labels ? labelled_ : distances_;
  if (!target) target.emplace(width_, height_, labels);
  target->begin();
  for (std::size_t k = 0; k < picture.views.cameras.size(); ++k) {
    render::Camera camera = picture.views.cameras[k];
    camera.pose = view.device * camera.pose;
    camera.far = view.max_range;
    camera.ignored_robot = view.ignored_robot;
    renderer_->draw(camera, *target, picture.tops[k]);
  }
  inverse_.resize(std::size_t(width_) * picture.height);
  target->read(std::span(inverse_));
  if (!labels) return;
  labels_.resize(inverse_.size());
  target->read(std::span(labels_));
}

ObjectId ZBuffer::holder_of(const scanner::View& view) const {
  for (const render::Volume& v : scene_.volumes())
    if ((v.robot < 0 || v.robot != view.ignored_robot) && v.holds(view.device.position)) return v.object;
  return no_object;
}

void ZBuffer::cast(std::size_t set, const scanner::View& view, std::span<double> ranges, std::span<ObjectId> hits) {
  const bool exists = view.device.position.allFinite() && view.device.orientation.coeffs().allFinite();
  const ObjectId holder = exists ? holder_of(view) : no_object;
  if (!exists || holder != no_object) {
    std::fill(ranges.begin(), ranges.end(), exists ? view.min_range : view.max_range);
    std::fill(hits.begin(), hits.end(), holder);
    return;
  }
  const Picture& picture = pictures_[set];
  draw(picture, view, !hits.empty());
  for (std::size_t k = 0; k < picture.resampling.size(); ++k) {
    const auto& [s, columns] = picture.resampling[k];
    const render::Camera& camera = picture.views.cameras[k];
    const auto stride = std::int32_t(width_);
    found_.resize(std::max(found_.size(), s.room()));
    if (columns.size() > 0)
      sample_grid(&inverse_[std::size_t(picture.tops[k]) * width_], stride, camera.height, columns, s, between_columns_,
                  found_.data());
    else
      sample(extent_of(camera), inverse_.data(), stride, s, found_.data());
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double inverse = double(found_[i]);
      const double range = inverse > 0 ? near_plane / inverse * s.per_depth[i] : view.max_range;
      ranges[s.ray[i]] = std::clamp(range, view.min_range, view.max_range);
      if (!hits.empty())
        hits[s.ray[i]] = range < view.max_range ? ObjectId(labels_[std::size_t(s.nearest[i])]) : no_object;
    }
  }
}

}  // namespace muro::zbuffer
