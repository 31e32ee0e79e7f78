// SPDX-License-Identifier: MIT
// Runs a scenario for a while and writes one hash for each property of each object, as JSON sorted by name:
//
//     property_hashes SCENARIO.yaml --duration SECONDS [--threads N] [--by-key] --out FILE.json
//
// A line is "object:key": "CLASS HASH", where CLASS is constant, variable or derived. Two versions of muro that compute
// the same write the same file. `property_hashes --c-library` prints a hash of results of elementary functions of the C
// library. Exit codes: 0 done, 1 the simulation failed, 2 wrong input.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "muro/base/random.hpp"
#include "tests/golden/property_hashes.hpp"

namespace {

using namespace muro;

struct Options {
  std::string scenario;
  std::string out;
  double duration = -1;  ///< s
  unsigned threads = 0;  ///< 0: as the scenario says
  bool by_key = false;   ///< one hash for all properties of a name
};

Options parse(int argc, char** argv) {
  Options options;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--by-key") {
        options.by_key = true;
        continue;
      }
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
    options = {};  // An argument that should be a number is not one.
  }
  if (options.scenario.empty() || options.out.empty() || !(options.duration >= 0))
    throw SetupError(
        "usage: property_hashes SCENARIO.yaml --duration SECONDS [--threads N] [--by-key] --out FILE.json");
  return options;
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
  const auto hashes = test::property_hashes(simulation.world());
  file << nlohmann::json(options.by_key ? test::hashes_by_key(hashes) : hashes).dump(2) << "\n";
  if (!file.flush()) throw SetupError("cannot write " + options.out);
}

std::uint64_t hash_of_c_library() {
  std::uint64_t hash = fnv1a("");
  for (int i = 1; i < 100'000; ++i) {
    const double x = 1e-3 * i;
    for (const double y : {std::sin(x), std::exp(0.01 * x), std::log(x), std::pow(x, 0.7), std::atan2(x, 3)})
      hash = fnv1a({reinterpret_cast<const char*>(&y), sizeof y}, hash);
  }
  return hash;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--c-library") {
    std::printf("%016llx\n", static_cast<unsigned long long>(hash_of_c_library()));
    return 0;
  }
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
