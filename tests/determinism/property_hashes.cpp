// SPDX-License-Identifier: MIT
// Runs a scenario for a while and writes one hash for each property of each object, as JSON sorted by name:
//
//     property_hashes SCENARIO.yaml --duration SECONDS [--threads N] --out FILE.json
//
// A line is "object:key": "CLASS HASH", where CLASS is constant, variable or derived. Two versions of muro that compute
// the same write the same file. Exit codes: 0 done, 1 the simulation failed, 2 wrong input.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "host/scenario/builder.hpp"

namespace {

using namespace muro;

/// In the order of Slot::Class.
constexpr const char* class_names[] = {"unknown", "constant", "variable", "derived"};

struct Options {
  std::string scenario;
  std::string out;
  double duration = -1;  ///< s
  unsigned threads = 0;  ///< 0: as the scenario says
};

Options parse(int argc, char** argv) {
  Options options;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      const std::string value = word.starts_with("--") && i + 1 < argc ? argv[++i] : "";
      if (word == "--duration") {
        options.duration = std::stod(value);
      } else if (word == "--threads") {
        options.threads = unsigned(std::stoul(value));
      } else if (word == "--out") {
        options.out = value;
      } else {
        options.scenario = word;
      }
    }
  } catch (const std::logic_error&) {
    options = {};  // What should be a number is none.
  }
  if (options.scenario.empty() || options.out.empty() || !(options.duration >= 0))
    throw SetupError("usage: property_hashes SCENARIO.yaml --duration SECONDS [--threads N] --out FILE.json");
  return options;
}

/// The hash of what a property holds now; none where nothing has been set aside for it.
std::optional<std::uint64_t> hash_of(const Slot& slot, std::size_t element_size) {
  if (slot.multiplicity == Multiplicity::list && slot.place) {
    const auto& list = *static_cast<const ListHeader*>(slot.place);
    return hash_bytes(list.data, list.size * element_size, 0);
  }
  if (slot.multiplicity == Multiplicity::array && slot.array)
    return hash_bytes(slot.array->data, slot.array->size * element_size, 0);
  if (slot.place) return hash_bytes(slot.place, element_size, 0);
  if (slot.parts.empty()) return std::nullopt;
  std::uint64_t h = 0;  // A sum is its contributions, one after the other.
  for (const void* part : slot.parts) h = hash_bytes(part, element_size, h);
  return h;
}

/// Transient values are left out, since they hold addresses. A place in memory that has several names has a line for
/// each.
nlohmann::json hashes_of(const World& world) {
  nlohmann::json all = nlohmann::json::object();
  const PropertyStore& store = world.store();
  for (std::uint32_t i = 0; i < world.object_count(); ++i) {
    for (const PropertyStore::Named& named : store.properties(ObjectId{i})) {
      const Slot& slot = store.slot(named.slot);
      const ValueType& type = *store.key_of(slot).type;
      const std::optional<std::uint64_t> hash = hash_of(slot, type.size);
      if (!hash || slot.kind == Slot::Class::unknown || type.scalar == Scalar::transient) continue;
      char text[32];
      std::snprintf(text, sizeof text, "%s %016llx", class_names[std::size_t(slot.kind)], (unsigned long long)*hash);
      all[world.object_name(ObjectId{i}) + ":" + std::string(named.key)] = text;
    }
  }
  return all;
}

void run(const Options& options) {
  Registry registry(Registry::search_path());
  host::BuiltScenario built = host::build(host::read_scenario(options.scenario, {}), registry);
  Simulation& simulation = *built.simulation;
  if (options.threads > 0) {
    simulation.set_threads(options.threads);
    simulation.scheduler().executor().set_always_parallel(true);  // All threads are used wherever calls may overlap.
  }
  simulation.run_until(std::llround(options.duration * 1e9));
  simulation.finish();
  std::ofstream file(options.out);
  file << hashes_of(simulation.world()).dump(2) << "\n";
  if (!file.flush()) throw SetupError("cannot write " + options.out);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse(argc, argv));
  } catch (const SetupError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
