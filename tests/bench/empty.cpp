// SPDX-License-Identifier: MIT
// Algorithms that do nothing, to measure the cost of a call.
#include "muro/plugin.hpp"

namespace {

using namespace muro;

class Empty final : public Algorithm {
 public:
  void connect(Connector&) override {}
  void step(const Step&, Range) override {}
};

constexpr Description one_robot{
    .id = "bench.empty",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Does nothing; each robot has an instance of its own",
    .capabilities = deterministic | allocation_free | restorable,
};
constexpr Description all_robots{
    .id = "bench.empty_batch",
    .kind = Kind::controller,
    .version = "1.0.0",
    .summary = "Does nothing; one instance for all robots",
    .capabilities = deterministic | batched | allocation_free | restorable,
};
constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Empty>(one_robot), algorithm<Empty>(all_robots)};

}  // namespace

MURO_PLUGIN(.name = "bench_empty", .version = "1.0.0", .licence = "MIT", .summary = "Algorithms that do nothing",
            .algorithms = algorithms)
