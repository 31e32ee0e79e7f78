// SPDX-License-Identifier: MIT
// A laser scanner that casts rays with Embree; see README.md.
#include "plugins/laser/common/embree/embree_method.hpp"
#include "plugins/laser/common/scanner/scanner.hpp"

namespace {

using namespace muro;

constexpr PropertyUse reads[] = {{"pose", "of the sensor's object and of all bodies that are seen"},
                                 {"collision.shapes", "of all bodies"}};
constexpr Description description{
    .id = "laser.embree",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "A laser scanner by Embree: distances along rays to any shape and to the triangles of meshes",
    .parameters = scanner::parameters,
    .reads = reads,
    .writes = scanner::writes,
    .capabilities = deterministic | batched | restorable,
};

class Embree final : public scanner::Scanner {
 public:
  Embree() : Scanner(std::make_unique<embree::Embree>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Embree>(description)};

}  // namespace

MURO_PLUGIN(.name = "laser_embree", .version = description.version, .licence = "MIT",
            .summary = "Laser scanner by Embree", .algorithms = algorithms)
