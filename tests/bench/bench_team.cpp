// SPDX-License-Identifier: MIT
// Number of vehicles in real time: the measurements of the MuRoSimF paper, Section 5.2 and Table 2. They have a team in
// a city with collision and dynamics at 1000 Hz, without and with laser scanners at 10 Hz; the paper's figures are
// beside ours. Then follows the example examples/urban as it is, with its control code, at each level of motion.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "host/outputs/report.hpp"
#include "host/scenario/builder.hpp"
#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// A team at 1000 Hz. Its scanners, if any, scan every 100 ms, on their own or in `scanners`.
struct Contender {
  std::unique_ptr<Team> team;
  std::unique_ptr<Scanners> scanners;
};
using Make = std::function<Contender(const City&)>;

/// Returns simulated s per s of wall-clock time.
double real_time_factor(int vehicles, const Make& make) {
  const City city(vehicles);
  const Contender c = make(city);
  std::vector<Pose> poses(city.starts().size());
  std::vector<double> factors;
  for (int k = 0; k < 10; ++k) {
    const double start = now();
    for (int v = 0; v < vehicles; ++v)
      if (city.changes(v, k)) c.team->command(v, city.command(v, k));
    if (c.scanners) {
      for (int v = 0; v < vehicles; ++v) poses[std::size_t(v)] = c.team->pose(v);
      c.scanners->scan(poses, true);
    }
    c.team->run(City::interval);
    if (k >= 3) factors.push_back(1e-3 * City::interval / (now() - start));
  }
  std::sort(factors.begin(), factors.end());
  return factors[factors.size() / 2];
}

/// Returns the number of vehicles that take as long as their simulated time. Each try has the number of vehicles that
/// follows from the last one.
double vehicles_in_real_time(const Make& make) {
  double vehicles = 300;
  for (int attempt = 0; attempt < 3; ++attempt)
    vehicles = std::max(1.0, std::round(vehicles)) * real_time_factor(int(std::max(1.0, std::round(vehicles))), make);
  return vehicles;
}

Make muro_with(int threads, const Pattern* lasers, const std::string& method = "laser.raycast") {
  return [threads, lasers, method](const City& city) {
    return Contender{std::make_unique<MuroTeam>(city, threads, Wheels::balls, MotionSetup{}, lasers, method), nullptr};
  };
}

/// Returns the fastest of the other engines: vehicles as one body, and rays in packets.
Make baselines_with(const Pattern* lasers) {
  const std::vector<Engine> engines = baselines();
  const auto body = std::find_if(engines.begin(), engines.end(),
                                 [](const Engine& e) { return e.name == "ODE, one body, 4 iterations"; });
  const std::vector<RayEngine> casters = ray_baselines();
  const auto caster =
      std::find_if(casters.begin(), casters.end(), [](const RayEngine& e) { return e.name == "rtcIntersect16"; });
  if (body == engines.end() || caster == casters.end()) return {};
  return [body = *body, caster = *caster, lasers](const City& city) {
    return Contender{body.make(city, body.settings), lasers ? caster.make(city, *lasers, 5.6) : nullptr};
  };
}

/// Figures of the paper for its computers A (1.67 GHz, two cores; with scanners on one) and B (1.86 GHz).
struct PaperRow {
  int columns, rows;
  const char *rays_a, *rays_b, *z_buffer_a, *z_buffer_b;
};
constexpr PaperRow paper[] = {{10, 1, "9", "16", "7", "12"},
                              {100, 1, "5", "10", "7", "10"},
                              {100, 10, "2", "2", "5", "6"},
                              {100, 100, "", "", "2", "5"},
                              {682, 1, "", "", "", ""}};

void section_5_2(Report& report) {
  report.table("Section 5.2: vehicles in real time without lasers, collision and dynamics at 1000 Hz",
               {"threads", "paper, computer A", "paper, computer B", "muro", "ODE, one body, 4 iterations"});
  const double one = vehicles_in_real_time(muro_with(1, nullptr)), two = vehicles_in_real_time(muro_with(2, nullptr));
  const Make others = baselines_with(nullptr);
  const double baseline = others ? vehicles_in_real_time(others) : 0;
  report.row({1, 20, 19, whole(one), others ? Cell(whole(baseline)) : Cell("")});
  report.row({2, 30, "", whole(two), ""});
  if (others) report.ratio("vehicles in real time, one thread: muro to ODE, one body", one / baseline);
}

void table_2(Report& report) {
  report.table(
      "Table 2: vehicles in real time with laser scanners at 10 Hz, motion and collision at 1000 Hz",
      {"rays", "paper, rays, A", "paper, rays, B", "paper, z-buffer, A", "paper, z-buffer, B", "muro, rays, 1 thread",
       "muro, rays, 2 threads", "muro, z-buffer, 1 thread", "ODE and Embree, 1 thread", "muro is faster by"});
  for (const PaperRow& p : paper) {
    const Pattern pattern(p.columns, p.rows);
    const double one = vehicles_in_real_time(muro_with(1, &pattern)),
                 two = vehicles_in_real_time(muro_with(2, &pattern));
    const double pictures = vehicles_in_real_time(muro_with(1, &pattern, "laser.zbuffer"));
    const Make others = baselines_with(&pattern);
    const double baseline = others ? vehicles_in_real_time(others) : 0;
    report.row({pattern.name(), p.rays_a, p.rays_b, p.z_buffer_a, p.z_buffer_b, whole(one), whole(two), whole(pictures),
                others ? Cell(whole(baseline)) : Cell(""), others ? Cell(fixed(one / baseline, 1)) : Cell("")});
    if (pattern.name() == "100x10")
      report.ratio("vehicles in real time with 100x10 rays at 10 Hz, one thread", one, "at least 1000");
  }
}

struct UrbanRun {
  double factor = 0;    ///< simulated s per wall-clock s
  double distance = 0;  ///< m that a vehicle travels on average: shows that vehicles do drive
};

/// Runs examples/urban. Without lasers nothing can steer, so each vehicle gets one command at the start.
UrbanRun run_urban(const std::string& motion, int vehicles, bool laser) {
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
  const double start = now();
  double simulated = 0;
  while (simulated < 2 || (now() - start < 1 && simulated < 30)) {
    s.run_for(0.1);
    simulated += 0.1;
    odometer.sample();
  }
  UrbanRun run{simulated / (now() - start), 0};
  for (const RobotView* r : s.world().robots()) run.distance += odometer.distance(r->number) / vehicles;
  return run;
}

void urban(Report& report) {
  report.table("examples/urban, one thread", {"motion", "lasers (682 rays, 10 Hz) and control", "vehicles",
                                              "times real time", "vehicles in real time", "m driven each"});
  for (const char* motion : {"motion.simplified", "motion.differential_drive", "motion.point"})
    for (const bool laser : {false, true})
      for (const int vehicles : {20, 100}) {
        const UrbanRun r = run_urban(motion, vehicles, laser);
        report.row({motion, laser ? "yes" : "no", vehicles, fixed(r.factor, 2), whole(r.factor * vehicles),
                    fixed(r.distance, 1)});
      }
}

}  // namespace

int main(int argc, char** argv) {
  Report report("team", "Vehicles in real time: the paper's measurements", argc, argv);
  section_5_2(report);
  table_2(report);
  urban(report);
  report.note(
      "Vehicles in real time: so many that their simulation takes as long as it simulates, measured with that many. "
      "The paper's scanner has no stated range; ours have 5.6 m.");
  report.finish();
  return 0;
}
