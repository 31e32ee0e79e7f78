// SPDX-License-Identifier: MIT
// Stands in for load.cpp and hull.cpp where Assimp or Qhull was missing when muro was configured.
#include "hull.hpp"
#include "muro/algorithm.hpp"
#include "submesh.hpp"

namespace muro::mesh {
namespace {

constexpr const char* advice =
    "this muro was built without meshes; install libassimp-dev and libqhull-dev, configure and build again";

}  // namespace

Mesh load(const std::string& path, const Vec3&) { throw Error("mesh " + path + ": " + advice); }
std::vector<Submesh> load_submeshes(const std::string& path, const Vec3&) {
  throw Error("mesh " + path + ": " + advice);
}
Hull convex_hull(std::span<const Vec3>) { throw Error(advice); }
Mesh surface_of(const Hull&) { throw Error(advice); }

}  // namespace muro::mesh
