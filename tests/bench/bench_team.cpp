// SPDX-License-Identifier: MIT
// How many vehicles in real time? The measurement of the MuRoSimF paper, Section 5.2: the urban team with collision and
// dynamics at 1000 Hz and controllers, without and with laser scanners, at each level of motion. The result is a table
// in Markdown with the machine and the command, and the same as JSON in FILE when one is named.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/report.hpp"
#include "host/scenario/builder.hpp"
#include "tests/support/scene.hpp"

namespace {

using namespace muro;

struct Row {
  std::string motion;
  int vehicles = 0;
  bool laser = false;
  double factor = 0;    ///< simulated s per wall-clock s
  double distance = 0;  ///< m that a vehicle travels on average: they really drive
};

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// Without lasers nothing can steer, so the vehicles are told once where to drive.
Row measure(const std::string& motion, int vehicles, bool laser) {
  std::vector<std::string> overrides = {"robots.rovers.count=" + std::to_string(vehicles),
                                        "robots.rovers.motion.use=" + motion};
  if (!laser) overrides.insert(overrides.end(), {"robots.rovers.laser=off", "robots.rovers.control=off"});
  const auto built =
      host::build(host::read_scenario(MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml", overrides), test::plugins());
  Simulation& s = *built.simulation;
  if (!laser)
    for (const RobotView* r : s.world().robots())
      s.world().value(r->base(), keys::command_twist) = {{0.6, 0, 0}, {0, 0, 0.4 * (r->number % 3) - 0.4}};
  s.run_for(0.5);  // warm
  host::Odometer odometer(s);
  const auto start = std::chrono::steady_clock::now();
  const auto wall = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  double simulated = 0;
  while (simulated < 5 || (wall() < 1 && simulated < 30)) {
    s.run_for(0.1);
    simulated += 0.1;
    odometer.sample();
  }
  Row row{motion, vehicles, laser, simulated / wall(), 0};
  for (const RobotView* r : s.world().robots()) row.distance += odometer.distance(r->number) / vehicles;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  nlohmann::ordered_json out = {{"machine", machine()}, {"command", "./dev bench team"}, {"threads", 1}};
  fmt::print("{}; one thread; ./dev bench team\n\n", machine());
  fmt::print(
      "| motion | lasers (682 rays, 10 Hz) | vehicles | times real time | vehicles in real time | m driven each "
      "|\n|---|---|---|---|---|---|\n");
  for (const char* motion : {"motion.simplified", "motion.differential_drive", "motion.point"})
    for (const bool laser : {false, true})
      for (const int vehicles : {20, 100}) {
        const Row r = measure(motion, vehicles, laser);
        fmt::print("| {} | {} | {} | {:.2f} | {:.0f} | {:.1f} |\n", r.motion, r.laser ? "yes" : "no", r.vehicles,
                   r.factor, r.factor * r.vehicles, r.distance);
        std::fflush(stdout);
        out["rows"].push_back({{"motion", r.motion},
                               {"lasers", r.laser},
                               {"vehicles", r.vehicles},
                               {"real_time_factor", r.factor},
                               {"driven_m", r.distance}});
      }
  fmt::print("\nThe paper (2008): 20 vehicles in real time on one core of 1.67 GHz, without lasers.\n");
  if (argc > 1) host::write_file(argv[1], out.dump(2) + "\n");
  return 0;
}
