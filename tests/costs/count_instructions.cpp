// SPDX-License-Identifier: MIT
// Runs scenes for callgrind, which counts only the instructions of their steps:
//
//     valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file=OUT ... count_instructions LIST
//
// LIST has lines as in a file of budgets (budgets.hpp). Each scene runs for its warm-up. Then callgrind counts the
// instructions of the rest, on one thread, and writes them to OUT.1, OUT.2, ...
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "tests/costs/budgets.hpp"
#include "valgrind/callgrind.h"

int main(int argc, char** argv) {
  using namespace muro;
  try {
    if (argc != 2) throw SetupError("usage: count_instructions LIST");
    Registry registry(Registry::search_path());
    for (const costs::SceneBudget& scene : costs::read_budgets(argv[1])) {
      host::BuiltScenario built =
          host::build(host::read_scenario(MURO_TEST_SOURCE_DIR "/" + scene.scenario, scene.overrides), registry);
      Simulation& simulation = *built.simulation;
      simulation.set_threads(1);
      simulation.run_until(std::llround(1e9 * scene.warm_up));
      CALLGRIND_START_INSTRUMENTATION;
      CALLGRIND_ZERO_STATS;
      simulation.run_until(std::llround(1e9 * (scene.warm_up + scene.duration)));
      CALLGRIND_DUMP_STATS_AT(scene.name.c_str());
      CALLGRIND_STOP_INSTRUMENTATION;
      simulation.finish();
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return 0;
}
