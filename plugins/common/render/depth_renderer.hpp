// SPDX-License-Identifier: MIT
// Distances, and whose they are. To be made and used while the context is current.
#pragma once

#include "program.hpp"
#include "stage.hpp"
#include "target.hpp"

namespace muro::render {

class DepthRenderer {
 public:
  explicit DepthRenderer(Stage& stage);

  /// Draws what the camera sees into the rows of the target from `top` on, as many as the camera has. The target has
  /// begun.
  void draw(const Camera& camera, const DepthTarget& target, std::uint32_t top = 0);

 private:
  Stage* stage_;
  Program distances_, labels_;
};

}  // namespace muro::render
