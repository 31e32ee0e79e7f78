// SPDX-License-Identifier: MIT
// A laser scanner that uses depth images (MuRoSimF, Section 4.1); see README.md.
#include "plugins/laser/common/scanner/scanner.hpp"
#include "plugins/laser/common/zbuffer/zbuffer_method.hpp"

namespace {

using namespace muro;

constexpr Parameter own[] = {zbuffer::supersampling, zbuffer::device_parameter};
constexpr auto parameters = scanner::joined(scanner::parameters, own);
constexpr PropertyUse reads[] = {{"pose", "of the sensor's object and of all bodies that are seen"},
                                 {"collision.shapes", "of all bodies"}};
constexpr Description description{
    .id = "laser.zbuffer",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "A laser scanner by depth images: many rays at once, any shape and mesh; by a GPU where there is one",
    .parameters = parameters,
    .reads = reads,
    .writes = scanner::writes,
    .capabilities = deterministic | batched | restorable,
};

class ZBuffer final : public scanner::Scanner {
 public:
  ZBuffer() : Scanner(std::make_unique<zbuffer::ZBuffer>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<ZBuffer>(description)};

}  // namespace

MURO_PLUGIN(.name = "laser_zbuffer", .version = description.version, .licence = "MIT",
            .summary = "Laser scanner by depth images", .algorithms = algorithms)
