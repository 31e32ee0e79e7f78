// SPDX-License-Identifier: MIT
// Scenarios, and descriptions of plugins.
#include "core/error.hpp"
#include "core/plugin_folder.hpp"
#include "host/scenario/scenario.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

void read_as_scenario(Bytes bytes) {
  const std::string file = file_with(bytes, "scenario.yaml");
  try {
    const host::Scenario scenario = host::read_scenario(file, {});
    for (const host::RobotTemplate& t : scenario.robots)
      require(t.subsystems.size() == std::size_t(t.count), "a robot has no subsystems, or too many");
  } catch (const SetupError& e) {
    outcome(e.what());
  }
}

void read_as_description(Bytes bytes) {
  file_with(bytes, "plugin.muro.json");
  try {
    for (const CatalogEntry& entry : read_description_of(file_with({}, "plugin.so")))
      require(!entry.library.empty(), "an entry has no library");
  } catch (const SetupError& e) {
    outcome(e.what());
  }
}

}  // namespace muro::fuzz
