// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "plugins/common/render/depth_renderer.hpp"
#include "plugins/common/render/device.hpp"
#include "plugins/common/scanner/method.hpp"
#include "sampling.hpp"
#include "views.hpp"

namespace muro::zbuffer {

// Its own parameters.
inline constexpr Parameter supersampling =
    real("supersampling", "1", 1, "pixels a ray, across and down").between(0.1, 64);
using render::device_parameter;

/// Distances from depth pictures by OpenGL. Calls come from one thread at a time.
class ZBuffer final : public scanner::Method {
 public:
  ~ZBuffer() override;

  void connect(Connector& c) override;
  void prepare(std::span<const scanner::RaySet> sets) override;
  void start() override;
  void look() override;
  void cast(std::size_t set, const scanner::View& view, std::span<double> ranges, std::span<ObjectId> hits) override;
  bool is_parallel() const override { return false; }
  bool is_cheap_for_few() const override { return false; }

 private:
  /// What is drawn for a set of rays: its pictures lie one below the other.
  struct Picture {
    Views views;
    std::uint32_t columns = 0;  ///< of rays, where they lie in rows and columns; else 0
    std::uint32_t height = 0;
    std::vector<std::uint32_t> tops;  ///< first row of each view
    struct Resampling {
      Samples samples;
      Samples columns;  ///< of rays in rows and columns; else empty
    };
    std::vector<Resampling> resampling;  ///< of each view
  };

  void place_samples(Picture& picture) const;
  void draw(const Picture& picture, const scanner::View& view, bool labels);
  /// Whether the eye is in something solid, and in what.
  ObjectId holder_of(const scanner::View& view) const;

  double supersampling_ = 1;
  render::Device device_ = render::Device::any;
  Host* host_ = nullptr;
  render::Scene scene_;
  std::vector<Picture> pictures_;
  std::uint32_t width_ = 1, height_ = 1;  ///< that hold any picture
  bool moved_ = true;                     ///< since the stage was placed
  std::optional<render::Context> context_;
  std::optional<render::Stage> stage_;
  std::optional<render::DepthRenderer> renderer_;
  std::optional<render::DepthTarget> distances_, labelled_;
  std::vector<float> inverse_;  ///< 1 / depth, as drawn
  std::vector<float> found_;    ///< likewise, at the samples of a view
  std::vector<float> between_columns_;
  std::vector<std::uint32_t> labels_;
};

}  // namespace muro::zbuffer
