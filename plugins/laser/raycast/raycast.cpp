// SPDX-License-Identifier: MIT
// A laser scanner that casts rays exactly; see README.md.
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/laser/common/raycast/raycast_method.hpp"
#include "plugins/laser/common/scanner/scanner.hpp"

namespace {

using namespace muro;

constexpr PropertyUse reads[] = {{"pose", "of the sensor's object"}, {"scene.index", "of the world"}};
constexpr Description description{
    .id = "laser.raycast",
    .kind = Kind::sensor,
    .version = "1.1.0",
    .summary =
        "A laser scanner with any pattern of rays: exact distances to boxes, spheres, cylinders, capsules, planes, "
        "heightmaps",
    .parameters = scanner::parameters,
    .reads = reads,
    .writes = scanner::writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Raycast final : public scanner::Scanner {
 public:
  Raycast() : Scanner(std::make_unique<raycast::Raycast>()) {}

  void connect(Connector& c) override {
    Scanner::connect(c);
    const raycast::MeshCount meshes = raycast::count_meshes(c);
    if (meshes.count > 0 && !mesh::is_any_refused(c))
      c.host().log(LogLevel::warning, "laser.raycast does not see meshes: " + std::to_string(meshes.count) +
                                          " collision shapes are left out, the first on " +
                                          std::string(meshes.first_object) +
                                          "; laser.embree and laser.zbuffer see them");
  }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Raycast>(description)};

}  // namespace

MURO_PLUGIN(.name = "laser_raycast", .version = description.version, .licence = "MIT",
            .summary = "Laser scanner by ray casting", .algorithms = algorithms)
