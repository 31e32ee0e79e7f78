// SPDX-License-Identifier: MIT
// Chooses which of its motions moves a robot: by time, by distance to other robots, by contact.
#include "muro/plugin.hpp"
#include "plugins/level/common/level_rules/rules_algorithm.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "level.rules",
    .kind = Kind::level,
    .version = "2.0.0",
    .summary = "Hands a robot over between its motions by time, distance and contact",
    .parameters = level::parameters,
    .reads = level::reads,
    .writes = level::writes,
    .capabilities = deterministic | allocation_free | restorable,
};

class LevelRules final : public level::RulesAlgorithm {
 public:
  LevelRules() : RulesAlgorithm(false) {}
  void step(const Step& step, Range range) override { choose(step, range); }
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LevelRules>(description)};

}  // namespace

MURO_PLUGIN(.name = "level_rules", .version = description.version, .licence = "MIT",
            .summary = "Rules by which robots change between their motions", .algorithms = algorithms)
