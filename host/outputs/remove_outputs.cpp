// SPDX-License-Identifier: MIT
#include "host/outputs/remove_outputs.hpp"

#include <algorithm>
#include <set>

namespace muro::host {

void remove_outputs(Scenario& scenario, const Registry& registry) {
  std::set<std::string> removed;
  std::erase_if(scenario.algorithms, [&](const Subsystem& a) {
    const auto entry = std::find_if(registry.catalog().begin(), registry.catalog().end(),
                                    [&](const CatalogEntry& e) { return e.id == a.use; });
    const bool output = entry != registry.catalog().end() &&
                        (entry->kind == name_of(Kind::recorder) || entry->kind == name_of(Kind::view));
    if (output) removed.insert(a.name);
    return output;
  });
  for (auto& sequence : scenario.sequences)
    std::erase_if(sequence, [&](const Name& n) { return removed.count(n.text) > 0; });
  std::erase_if(scenario.sequences, [](const auto& sequence) { return sequence.size() < 2; });
}

}  // namespace muro::host
