// SPDX-License-Identifier: MIT
#include "tests/costs/count.hpp"

#include <stdexcept>

#include "tests/support/files.hpp"

namespace muro::costs {

std::vector<std::pair<SceneBudget, Costs>> count() {
  const test::ScratchFolder folder;
  const std::string out = folder.path("callgrind.out");
  const test::CommandResult run = test::run_command(
      "MURO_ISA=avx2 MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " MURO_CONTROLLER_PATH=" MURO_COSTS_CONTROLLERS
      " valgrind --quiet --tool=callgrind --instr-atstart=no --compress-strings=no --compress-pos=no --dump-line=no "
      "--callgrind-out-file=" +
      out + " " MURO_COUNT_INSTRUCTIONS " " + budgets_file);
  if (run.exit_code != 0) throw std::runtime_error("valgrind failed:\n" + run.output);
  std::vector<std::pair<SceneBudget, Costs>> costs;
  for (const SceneBudget& scene : read_budgets(budgets_file))
    costs.emplace_back(scene, read_callgrind(out + "." + std::to_string(costs.size() + 1), MURO_TEST_PLUGIN_DIR,
                                             MURO_COUNT_INSTRUCTIONS));
  return costs;
}

}  // namespace muro::costs
