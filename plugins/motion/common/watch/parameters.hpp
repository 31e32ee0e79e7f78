// SPDX-License-Identifier: MIT
// Parameters of the watch, equal for all motions by forces.
#pragma once

#include <string_view>

#include "muro/parameter.hpp"

namespace muro::watch {

inline constexpr std::string_view switches[] = {"on", "off"};
inline constexpr Parameter watch =
    text("watch", "on", "whether the run ends when a body passes one of the two limits that follow").one_of(switches);
inline constexpr Parameter watch_speed =
    real("watch_speed", "m/s", 0, "fastest that a body may become; 0: by its drives, its start and its fall")
        .between(0, 1e9);
inline constexpr Parameter watch_depth =
    real("watch_depth", "m", 0, "deepest that a body may sink into scenery; 0: by its size").between(0, 1e9);

}  // namespace muro::watch
