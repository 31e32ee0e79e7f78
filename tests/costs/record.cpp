// SPDX-License-Identifier: MIT
// Writes tests/costs/budgets.txt anew, with the costs of this build.
#include <cstdio>
#include <exception>

#include "tests/costs/count.hpp"

int main() {
  using namespace muro::costs;
  try {
    std::vector<SceneBudget> scenes;
    for (auto& [scene, costs] : count()) {
      for (const auto& [plugin, cost] : costs)
        if (const auto old = scene.costs.find(plugin); old != scene.costs.end())
          std::printf("%s: %s %.3f\n", scene.name.c_str(), plugin.c_str(),
                      double(cost.instructions) / double(old->second.instructions));
      scene.costs = costs;
      scenes.push_back(scene);
    }
    write_budgets(budgets_file, scenes);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
