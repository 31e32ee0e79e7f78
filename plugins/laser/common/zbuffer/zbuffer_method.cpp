// SPDX-License-Identifier: MIT
#include "zbuffer_method.hpp"

#include <algorithm>
#include <string>

#include "muro/algorithm.hpp"

namespace muro::zbuffer {

namespace {

constexpr double tolerance = 2e-4;  ///< m, largest error of the polygons that represent circles
/// m along the axis of a camera. Nearer surfaces are not drawn. The precision of depths does not depend on this value.
constexpr double near_plane = 1e-3;
constexpr std::uint32_t max_pixels = 8192;  ///< along a side; every OpenGL 4.5 can draw so many

ImageShape shape_of(const render::Camera& c) {
  if (c.width == 1) return c.height == 1 ? ImageShape::pixel : ImageShape::column;
  return c.height == 1 ? ImageShape::row : ImageShape::grid;
}

std::int32_t floor_of(double x) { return std::int32_t(std::max(x, 0.0)); }

}  // namespace

ZBuffer::~ZBuffer() {
  if (!context_) return;
  const render::Current current(*context_);
  depth_target_.reset();
  labelled_target_.reset();
  renderer_.reset();
  gpu_scene_.reset();
}

void ZBuffer::connect(Connector& c) {
  supersampling_ = c.parameters().real(supersampling.name);
  device_ = render::device_of(c.parameters());
  host_ = &c.host();
  scene_.connect(c, render::ShapeSource::collision, tolerance);
}

void ZBuffer::prepare(std::span<const scanner::RaySet> sets) {
  for (const scanner::RaySet& set : sets) {
    DepthImage image;
    image.rig = CameraRig::of(set, supersampling_);
    image.columns = set.rows > 1 ? set.columns : 0;
    const std::uint32_t width = image.rig.width();
    for (render::Camera& camera : image.rig.cameras) {
      camera.near = near_plane;
      image.tops.push_back(image.height);
      image.height += camera.height;
    }
    if (width > max_pixels || image.height > max_pixels)
      throw Error("the z-buffer would need " + std::to_string(width) + " x " + std::to_string(image.height) +
                  " pixels; at most " + std::to_string(max_pixels) +
                  " either way are possible: take fewer rays, less supersampling, or laser.raycast");
    width_ = std::max(width_, width);
    height_ = std::max(height_, image.height);
    images_.push_back(std::move(image));
  }
  for (DepthImage& image : images_) place_samples(image);
}

/// Computes the samples. Call it when the width of the target is known.
void ZBuffer::place_samples(DepthImage& image) const {
  image.resampling.resize(image.rig.cameras.size());
  const auto stride = std::int32_t(width_);
  // rays of one column of a camera share a column of interpolated pixels
  std::vector<std::int32_t> column_of(image.columns);
  for (std::uint32_t camera = 0; camera < image.resampling.size(); ++camera) {
    DepthImage::Resampling& r = image.resampling[camera];
    std::vector<std::uint32_t> rays;
    for (std::uint32_t ray = 0; ray < image.rig.samples.size(); ++ray)
      if (image.rig.samples[ray].camera == camera) rays.push_back(ray);
    std::fill(column_of.begin(), column_of.end(), -1);
    std::vector<double> columns;
    const render::Camera& size = image.rig.cameras[camera];
    bool is_grid = image.columns > 0 && size.height > 1 && size.width > 1;
    for (std::size_t i = 0; i < rays.size() && is_grid; ++i) {
      const double column = image.rig.samples[rays[i]].column;
      std::int32_t& number = column_of[rays[i] % image.columns];
      if (number < 0) {
        number = std::int32_t(columns.size());
        columns.push_back(column);
        r.columns.add(0, floor_of(column), float(column - floor_of(column)), 0, 0, 0);
      }
      is_grid = std::abs(columns[std::size_t(number)] - column) < 1e-6;
    }
    if (!is_grid) r.columns = {};
    if (is_grid) r.columns.pad();
    for (const std::uint32_t ray : rays) {
      const RaySample& s = image.rig.samples[ray];
      const std::int32_t column = floor_of(s.column), row = floor_of(s.row), top = std::int32_t(image.tops[camera]);
      const std::int32_t nearest = (top + floor_of(s.row + 0.5)) * stride + floor_of(s.column + 0.5);
      const std::int32_t pixel = is_grid ? row * std::int32_t(r.columns.padded_size()) + column_of[ray % image.columns]
                                         : (top + row) * stride + column;
      r.samples.add(ray, pixel, float(s.column - column), float(s.row - row), s.length_per_depth, nearest);
    }
    r.samples.pad();
  }
}

void ZBuffer::start() {
  is_outdated_ = true;
  if (context_) return;
  context_.emplace(device_);
  host_->log(LogLevel::info, "the z-buffer of lasers is drawn by " + context_->renderer());
}

void ZBuffer::update() { is_outdated_ = true; }

void ZBuffer::draw(const DepthImage& image, const scanner::Viewpoint& from, bool labels) {
  const render::Current current(*context_);
  if (!gpu_scene_) {
    gpu_scene_.emplace(scene_);
    renderer_.emplace(*gpu_scene_);
  }
  if (is_outdated_) gpu_scene_->update();
  is_outdated_ = false;
  std::optional<render::DepthTarget>& target = labels ? labelled_target_ : depth_target_;
  if (!target) target.emplace(width_, height_, labels);
  target->begin();
  for (std::size_t k = 0; k < image.rig.cameras.size(); ++k) {
    render::Camera camera = image.rig.cameras[k];
    camera.pose = from.device * camera.pose;
    camera.far = from.max_range;
    camera.ignored_robot = from.ignored_robot;
    renderer_->draw(camera, *target, image.tops[k]);
  }
  inverse_.resize(std::size_t(width_) * image.height);
  target->read(std::span(inverse_));
  if (!labels) return;
  labels_.resize(inverse_.size());
  target->read(std::span(labels_));
}

ObjectId ZBuffer::containing_object(const scanner::Viewpoint& from) const {
  for (const render::SolidShape& solid : scene_.solid_shapes())
    if ((solid.body.robot == no_robot || solid.body.robot != from.ignored_robot) &&
        solid.contains(from.device.position))
      return solid.body.object;
  return no_object;
}

void ZBuffer::cast(std::size_t set, const scanner::Viewpoint& from, std::span<double> ranges,
                   std::span<ObjectId> hits) {
  const bool is_finite = from.device.position.allFinite() && from.device.orientation.coeffs().allFinite();
  const ObjectId container = is_finite ? containing_object(from) : no_object;
  if (!is_finite || container != no_object) {
    std::fill(ranges.begin(), ranges.end(), is_finite ? from.min_range : from.max_range);
    std::fill(hits.begin(), hits.end(), container);
    return;
  }
  const DepthImage& image = images_[set];
  draw(image, from, !hits.empty());
  for (std::size_t k = 0; k < image.resampling.size(); ++k) {
    const auto& [s, columns] = image.resampling[k];
    const render::Camera& camera = image.rig.cameras[k];
    const auto stride = std::int32_t(width_);
    sampled_.resize(std::max(sampled_.size(), s.padded_size()));
    if (columns.size() > 0)
      sample_grid(&inverse_[std::size_t(image.tops[k]) * width_], stride, camera.height, columns, s, column_scratch_,
                  sampled_.data());
    else
      sample(shape_of(camera), inverse_.data(), stride, s, sampled_.data());
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double inverse = double(sampled_[i]);
      const double range = inverse > 0 ? near_plane / inverse * s.length_per_depth[i] : from.max_range;
      ranges[s.ray[i]] = std::clamp(range, from.min_range, from.max_range);
      if (!hits.empty())
        hits[s.ray[i]] = range < from.max_range ? ObjectId(labels_[std::size_t(s.nearest[i])]) : no_object;
    }
  }
}

}  // namespace muro::zbuffer
