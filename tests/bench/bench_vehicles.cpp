// SPDX-License-Identifier: MIT
// Steps of vehicles per second: muro beside raw Bullet, ODE and MuJoCo programs that drive the same vehicles through
// the same city by the same wheel commands, on one thread each (muro also on two), taking turns in one run.
//   --vehicles N   this number alone
//   --only TEXT    engines whose name contains TEXT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

/// One engine's share of a run.
struct Runner {
  Engine engine;
  std::unique_ptr<Team> team;
  std::vector<Vec3> last;
  std::vector<double> rates;  ///< vehicle-steps/s of each turn
  double distance = 0;        ///< m, mean of all vehicles, since the start
  double height = 0;          ///< m, mean of all vehicles and turns

  Runner(Engine e, const City& city) : engine(std::move(e)), team(engine.make(city)) {
    for (const Pose& p : city.starts()) last.push_back(p.position);
  }
  double rate() const {
    std::vector<double> sorted = rates;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  /// Intervals `from` to `to` - 1 of commands.
  void drive(const City& city, int from, int to, bool counts) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = from; k < to; ++k) {
      for (int v = 0; v < city.vehicles(); ++v)
        if (city.changes(v, k)) team->command(v, city.command(v, k));
      team->run(City::interval);
    }
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double sum = 0;
    for (int v = 0; v < city.vehicles(); ++v) {
      const Vec3 now = team->position(v);
      distance += (now - last[std::size_t(v)]).norm() / city.vehicles();
      last[std::size_t(v)] = now;
      sum += now.z() / city.vehicles();
    }
    if (!counts) return;
    height += sum;
    rates.push_back(double(city.vehicles()) * City::interval * (to - from) / wall);
  }
};

constexpr int turns = 5;

/// Simulated intervals of a turn, so that the slowest engine takes a few seconds in all.
int intervals_for(int vehicles) { return vehicles >= 1000 ? 2 : vehicles >= 100 ? 8 : vehicles >= 10 ? 40 : 120; }

std::vector<Runner> run(int vehicles, const std::vector<Engine>& engines) {
  const City city(vehicles);
  std::vector<Runner> runners;
  for (const Engine& e : engines) runners.emplace_back(e, city);
  const int length = intervals_for(vehicles);
  for (int turn = 0; turn <= turns; ++turn)  // the first warms up
    for (Runner& r : runners) r.drive(city, turn * length, (turn + 1) * length, turn > 0);
  return runners;
}

Engine muro_with(int threads) {
  return {fmt::format("muro, {} thread{}", threads, threads > 1 ? "s" : ""), true,
          [threads](const City& city) { return std::make_unique<MuroTeam>(city, threads); }};
}

}  // namespace

int main(int argc, char** argv) {
  Report report("vehicles", "Vehicles in the city: muro and other engines", argc, argv);
  std::vector<Engine> engines = {muro_with(1)};
  if (CityScene probe{City(1)}; set_threads(probe, 2)) engines.push_back(muro_with(2));
  for (Engine& e : peers()) engines.push_back(std::move(e));
  const std::string only = report.argument("only", "");
  std::erase_if(engines, [&](const Engine& e) { return e.name.find(only) == std::string::npos; });

  const int one = std::stoi(report.argument("vehicles", "0"));
  for (const int vehicles : one > 0 ? std::vector{one} : std::vector{1, 10, 100, 1000}) {
    const std::vector<Runner> runners = run(vehicles, engines);
    const double simulated = 1e-3 * City::interval * intervals_for(vehicles) * (turns + 1);
    report.table(fmt::format("N = {}, {:.1f} s of simulated time at 1000 Hz", vehicles, simulated),
                 {"engine", "a vehicle is", "vehicle-steps/s", "slowest turn", "fastest turn", "muro is faster by",
                  "driven, m", "height, m"});
    const double own = runners.front().rate();
    for (const Runner& r : runners) {
      const auto [slowest, fastest] = std::minmax_element(r.rates.begin(), r.rates.end());
      report.row({r.engine.name, r.engine.one_body ? "one body" : "five bodies", whole(r.rate()), whole(*slowest),
                  whole(*fastest), fixed(own / r.rate(), 1), fixed(r.distance, 2), fixed(r.height / turns, 4)});
    }
  }
  report.finish();
  return 0;
}
