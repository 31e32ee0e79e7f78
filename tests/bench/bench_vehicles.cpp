// SPDX-License-Identifier: MIT
// Steps of vehicles per second: muro, and raw Bullet, ODE and MuJoCo programs that drive the same vehicles through the
// same city by the same wheel commands, on one thread each (muro also on two), alternately in one run.
//   --vehicles N   only this number of vehicles
//   --only TEXT    engines whose name contains TEXT; tables of muro alone with `muro` and without this option
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/round_trip.hpp"
#include "tests/bench/team_runs.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr const char* one_thread = "muro, 1 thread";

int rate_of(SolverSettings e) { return 1000 * e.steps; }

Engine muro_with(int threads) {
  return {fmt::format("muro, {} thread{}", threads, threads > 1 ? "s" : ""), true,
          [threads](const City& city, SolverSettings e) {
            return std::make_unique<MuroTeam>(city, threads, Wheels::balls, nullptr, rate_of(e));
          }};
}
/// Returns muro with cylinders as wheels; the other engines have balls.
Engine muro_with_cylinders() {
  return {"muro, wheels as cylinders", true, [](const City& city, SolverSettings e) {
            return std::make_unique<MuroTeam>(city, 1, Wheels::cylinders, nullptr, rate_of(e));
          }};
}
/// Returns two independent teams, which show how much two threads of this machine can do.
Engine two_programs() {
  return {.name = "muro, two programs of 1 thread",
          .one_body = true,
          .make = [](const City& city, SolverSettings) { return std::make_unique<TwoTeams>(city); },
          .teams = 2};
}

const char* level(const Engine& e) { return e.one_body ? "one body" : "five bodies"; }
bool is_muro(const Engine& e) { return e.name.starts_with("muro"); }

/// Compares how well engines solve their equations. Returns the names of baselines with one body a vehicle that are as
/// accurate as muro, or more.
std::set<std::string> compare_accuracy(Report& report, const std::vector<Engine>& engines) {
  std::set<std::string> accurate;
  report.table(
      "10 vehicles on open ground, 6 s: away from where the same engine takes them with "
      "4 steps of 200 iterations each ms",
      {"engine", "a vehicle is", "root of mean square, mm", "maximum, mm"});
  double own = 0;
  for (const Engine& e : engines) {
    const bool is_baseline = e.one_body ? !is_muro(e) : e.name.starts_with("ODE");
    if (e.name != one_thread && !is_baseline) continue;
    const Deviation d = deviation(e);
    report.row({e.name, level(e), fixed(1e3 * d.rms, 2), fixed(1e3 * d.max, 2)});
    if (is_muro(e))
      own = d.rms;
    else if (e.one_body && d.rms <= own)
      accurate.insert(e.name);
  }
  return accurate;
}

void compare_with_baselines(Report& report, const std::vector<int>& teams, const std::vector<Engine>& engines,
                            const std::set<std::string>& accurate) {
  for (const int vehicles : teams) {
    const RunPlan plan = RunPlan::for_team(vehicles);
    const std::vector<Measurement> measurements =
        compare(plan, engines, [vehicles](std::uint64_t seed) { return City(vehicles, seed); });
    report.table(fmt::format("N = {}, {} x {:.1f} s at 1000 Hz", vehicles, plan.cities, plan.simulated()),
                 {"engine", "a vehicle is", "vehicle-steps/s", "slowest round", "fastest round", "muro is faster by",
                  "driven, m", "height, m"});
    const double own = is_muro(engines.front()) ? measurements.front().rate() : 0;
    double best = 0, best_accurate = 0;
    std::map<std::string, double> articulated;
    for (std::size_t e = 0; e < engines.size(); ++e) {
      const Measurement& r = measurements[e];
      const auto [slowest, fastest] = std::minmax_element(r.rates.begin(), r.rates.end());
      report.row({engines[e].name, level(engines[e]), whole(r.rate()), whole(*slowest), whole(*fastest),
                  own > 0 ? Cell(fixed(own / r.rate(), 1)) : Cell(""), fixed(r.distance, 2), fixed(r.height, 4)});
      if (own == 0 || is_muro(engines[e])) continue;
      if (engines[e].one_body) best = std::max(best, r.rate());
      if (accurate.contains(engines[e].name)) best_accurate = std::max(best_accurate, r.rate());
      if (engines[e].name.starts_with("ODE, articulated")) articulated[engines[e].name] = r.rate();
    }
    const bool large = vehicles >= 100;
    if (best_accurate > 0)
      report.ratio(fmt::format("N = {}: steps of vehicles, muro to the best baseline with one body that is as accurate",
                               vehicles),
                   own / best_accurate, large ? "at least 12" : "");
    if (best > 0) report.ratio(fmt::format("N = {}: the same, to the best that drives properly", vehicles), own / best);
    for (const auto& [name, rate] : articulated)
      report.ratio(fmt::format("N = {}: steps of vehicles, muro to {}", vehicles, name), own / rate,
                   large ? "at least 25" : "");
  }
}

/// Measures muro alone: the cost of a vehicle in teams of all sizes, on one thread and on two.
void compare_sizes(Report& report, const std::vector<int>& teams) {
  constexpr int repeats = 5;
  report.table(fmt::format("muro alone, 4 s at 1000 Hz; of {} runs, the fastest of each round", repeats),
               {"vehicles", "1 thread, vehicle-steps/s", "ns a vehicle and step", "2 threads, vehicle-steps/s",
                "2 threads to 1", "2 programs to 1", "thread to thread and back, ns"});
  const std::vector<Engine> engines = {muro_with(1), muro_with(2), two_programs()};
  for (const int vehicles : teams) {
    const double before = round_trip();
    const std::vector<Measurement> r = compare(RunPlan{vehicles < 100 ? 10 : 3, 3, 10, repeats}, engines,
                                               [vehicles](std::uint64_t seed) { return City(vehicles, seed); });
    const double one = r[0].rate(), speed_up = r[1].ratio_to(r[0]), max_speed_up = r[2].ratio_to(r[0]);
    report.row({vehicles, whole(one), whole(1e9 / one), whole(r[1].rate()), fixed(speed_up, 2), fixed(max_speed_up, 2),
                whole(std::max(before, round_trip()))});
    report.ratio(fmt::format("N = {}: two threads to one", vehicles), speed_up,
                 vehicles == 1000  ? "at least 1.8"
                 : vehicles == 100 ? "at least 1.7"
                                   : "at least 1");
  }
}

/// Measures small and large teams in cities that are equally full.
void compare_growth(Report& report) {
  report.table("muro alone, 1 thread, 4 s at 1000 Hz, 5.4 to 6 m of streets for each vehicle",
               {"vehicles", "vehicle-steps/s", "ns a vehicle and step", "the same on open ground"});
  const auto cost = [](int vehicles, auto make_city) {
    const RunPlan plan{vehicles < 100 ? 30 : 3, 3, 10};
    return 1e9 / compare(plan, {muro_with(1)}, make_city)[0].rate();
  };
  double of_twenty = 0;
  for (const int vehicles : {20, 100, 300, 1000}) {
    const double crowded = cost(vehicles, [=](std::uint64_t seed) { return City::crowded(vehicles, seed); });
    const double open = cost(vehicles, [=](std::uint64_t seed) { return City::open(vehicles, seed); });
    report.row({vehicles, whole(1e9 / crowded), whole(crowded), whole(open)});
    if (vehicles == 20) of_twenty = crowded;
    if (vehicles == 1000) report.ratio("cost of a vehicle among 1000 to among 20", crowded / of_twenty, "at most 1.3");
  }
}

}  // namespace

int main(int argc, char** argv) {
  Report report("vehicles", "Vehicles in the city: muro and other engines", argc, argv);
  std::vector<Engine> engines = {muro_with(1), muro_with(2), muro_with_cylinders()};
  for (Engine& e : baselines()) engines.push_back(std::move(e));
  const std::string only = report.argument("only", "");
  std::erase_if(engines, [&](const Engine& e) { return e.name.find(only) == std::string::npos; });

  const int one = std::stoi(report.argument("vehicles", "0"));
  compare_with_baselines(report, one > 0 ? std::vector{one} : std::vector{1, 10, 100, 1000}, engines,
                         compare_accuracy(report, engines));
  if (only.empty() || only == "muro") {
    compare_sizes(report, one > 0 ? std::vector{one} : std::vector{1, 3, 10, 20, 50, 100, 300, 1000});
    if (one == 0) compare_growth(report);
  }
  report.note("Bullet 3.24, ODE 0.16 and MuJoCo 2.2 are Debian's, in double precision.");
  report.finish();
  return 0;
}
