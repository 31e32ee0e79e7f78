// SPDX-License-Identifier: MIT
// The parameter by which a user chooses the GPU or the processor for rendering.
#pragma once

#include "context.hpp"
#include "muro/algorithm.hpp"

namespace muro::render {

inline constexpr std::string_view device_names[] = {"auto", "gpu", "software"};
inline constexpr Parameter device_parameter =
    text("device", "auto", "what draws: the first GPU that can, else the processor; or one of both")
        .one_of(device_names);

/// Its value. [setup]
inline Device device_of(const Parameters& p) {
  const std::string_view name = p.text(device_parameter.name);
  return name == "gpu" ? Device::gpu : name == "software" ? Device::software : Device::any;
}

}  // namespace muro::render
