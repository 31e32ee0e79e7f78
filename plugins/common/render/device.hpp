// SPDX-License-Identifier: MIT
// Parameter with which a user chooses the GPU or the processor for rendering.
#pragma once

#include "context.hpp"
#include "muro/algorithm.hpp"

namespace muro::render {

inline constexpr std::string_view device_names[] = {"auto", "gpu", "software"};
inline constexpr Parameter device_parameter =
    text("device", "auto", "what draws: the first GPU that can, else the processor; or one of both")
        .one_of(device_names);

/// Returns the value of the parameter. [setup]
inline Device device_of(const Parameters& p) {
  const std::string_view name = p.text(device_parameter.name);
  return name == "gpu" ? Device::gpu : name == "software" ? Device::software : Device::any;
}

}  // namespace muro::render
