// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <sdf/Link.hh>
#include <vector>

#include "library.hpp"
#include "muro/shape.hpp"

namespace muro::sdf {

/// Keeps a text for the life of the simulation.
using Intern = std::function<TextId(std::string_view)>;

/// Inertia and shapes of a link.
struct LinkBody {
  Inertia inertial;
  std::vector<Shape> collisions, visuals;
  std::vector<TextId> materials;  ///< names, one for each visual
};

/// Reads a link. `name`: the link in messages. Without `movable` the inertia is not needed and not checked.
LinkBody body_of(const ::sdf::Link& link, const std::string& name, bool movable, const SourceFiles& sources,
                 const Intern& intern, Problems& problems);

}  // namespace muro::sdf
