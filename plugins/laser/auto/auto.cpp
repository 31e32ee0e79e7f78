// SPDX-License-Identifier: MIT
// A laser scanner that uses the fastest method on this machine; see README.md.
#include "method_selector.hpp"
#include "plugins/laser/common/scanner/scanner.hpp"
#ifdef MURO_AUTO_ZBUFFER
#include "plugins/laser/common/zbuffer/zbuffer_method.hpp"
#endif

namespace {

using namespace muro;

constexpr std::string_view methods[] = {"auto", "raycast", "zbuffer", "embree"};
constexpr Parameter own_parameters[] = {
    text("method", "auto", "how distances are found; auto: the fastest, measured at the start").one_of(methods),
#ifdef MURO_AUTO_ZBUFFER
    zbuffer::supersampling,
    zbuffer::device_parameter,
#endif
};
constexpr auto parameters = scanner::joined(scanner::parameters, own_parameters);
constexpr PropertyUse reads[] = {{"pose", "of the sensor's object and of all bodies that are seen"},
                                 {"collision.shapes", "of all bodies"},
                                 {"scene.index", "of the world"}};
constexpr PropertyUse own_writes[] = {{"laser.method", "1: raycast, 2: zbuffer, 3: embree; 0: not chosen yet"}};
constexpr auto writes = scanner::joined(scanner::writes, own_writes);
constexpr Description description{
    .id = "laser.auto",
    .kind = Kind::sensor,
    .version = "1.0.0",
    .summary = "A laser scanner by the fastest of the other methods, measured at the start in the scene as it is",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = batched | restorable,
};

class Auto final : public scanner::Scanner {
 public:
  Auto() : Scanner(std::make_unique<laser_auto::MethodSelector>()) {}
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Auto>(description)};

}  // namespace

MURO_PLUGIN(.name = "laser_auto", .version = description.version, .licence = "MIT",
            .summary = "Laser scanner by the fastest method", .algorithms = algorithms)
