// SPDX-License-Identifier: MIT
// The named places of a scenario, as its reader leaves them on the world object (host/scenario/place_properties.hpp).
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::level {

inline constexpr Key<TextId> place_names{"place.names", "1", "name of the place to which each rectangle belongs"};
inline constexpr Key<double> place_rectangles{"place.rectangles", "m",
                                              "for each rectangle: x and y of its centre, lengths along x and y"};

}  // namespace muro::level
