// SPDX-License-Identifier: MIT
// Replaces hull.cpp if Qhull was missing when muro was configured.
#include "hull.hpp"
#include "muro/algorithm.hpp"

namespace muro::mesh {
namespace {

constexpr const char* advice =
    "this muro was built without convex hulls; install libqhull-dev, configure and build again";

}  // namespace

Hull convex_hull(std::span<const Vec3>) { throw Error(advice); }
Hull hull_or_plate(std::span<const Vec3>) { throw Error(advice); }
Mesh surface_of(const Hull&) { throw Error(advice); }

}  // namespace muro::mesh
