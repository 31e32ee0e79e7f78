// SPDX-License-Identifier: MIT
// The parameter by which a user chooses what draws.
#pragma once

#include "context.hpp"
#include "muro/algorithm.hpp"

namespace muro::render {

inline constexpr std::string_view device_words[] = {"auto", "gpu", "software"};
inline constexpr Parameter device_parameter =
    text("device", "auto", "what draws: the first GPU that can, else the processor; or one of both")
        .one_of(device_words);

/// What it says. [setup]
inline Device device_of(const Parameters& p) {
  const std::string_view word = p.text(device_parameter.name);
  return word == "gpu" ? Device::gpu : word == "software" ? Device::software : Device::any;
}

}  // namespace muro::render
