// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "camera_rig.hpp"
#include "plugins/common/render/depth_renderer.hpp"
#include "plugins/common/render/device.hpp"
#include "plugins/laser/common/scanner/method.hpp"
#include "sampling.hpp"

namespace muro::zbuffer {

// The parameters of this method.
inline constexpr Parameter supersampling =
    real("supersampling", "1", 1, "pixels for each ray, across and down").between(0.1, 64);
using render::device_parameter;

/// Distances from depth images by OpenGL. Calls come from one thread at a time.
class ZBuffer final : public scanner::Method {
 public:
  ~ZBuffer() override;

  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void update() override;
  void cast(std::size_t set, const scanner::Viewpoint& from, std::span<double> ranges,
            std::span<ObjectId> hits) override;
  bool is_parallel() const override { return false; }
  bool is_cheap_for_few_rays() const override { return false; }

 private:
  /// The image that is drawn for a set of rays: the images of its cameras, one below the other.
  struct DepthImage {
    CameraRig rig;
    std::uint32_t columns = 0;  ///< columns of rays that form a grid; otherwise 0
    std::uint32_t height = 0;
    std::vector<std::uint32_t> tops;  ///< first row of each camera
    struct Resampling {
      Samples samples;
      Samples columns;  ///< columns of rays that form a grid; otherwise empty
    };
    std::vector<Resampling> resampling;  ///< for each camera
  };

  void place_samples(DepthImage& image) const;
  void draw(const DepthImage& image, const scanner::Viewpoint& from, bool labels);
  /// Returns the object with a solid shape that contains the device, if any.
  ObjectId containing_object(const scanner::Viewpoint& from) const;

  double supersampling_ = 1;
  render::Device device_ = render::Device::any;
  Host* host_ = nullptr;
  render::Scene scene_;
  std::vector<DepthImage> images_;
  std::uint32_t width_ = 1, height_ = 1;  ///< size of a target large enough for each image
  bool is_outdated_ = true;               ///< whether bodies may have moved since the GPU scene was updated
  std::optional<render::Context> context_;
  std::optional<render::GpuScene> gpu_scene_;
  std::optional<render::DepthRenderer> renderer_;
  std::optional<render::DepthTarget> depth_target_, labelled_target_;
  std::vector<float> inverse_;  ///< 1 / depth, as drawn
  std::vector<float> sampled_;  ///< 1 / depth at the samples of a camera
  std::vector<float> column_scratch_;
  std::vector<std::uint32_t> labels_;
};

}  // namespace muro::zbuffer
