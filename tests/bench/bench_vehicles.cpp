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

/// How long an engine runs: fresh cities, each with a new seed, and in each of them timed turns behind a warm-up as
/// long as one. Runs are short, for vehicles that drive blindly end up at walls; the slowest engine takes some seconds
/// in all.
struct Plan {
  int cities, turns, intervals;
  static Plan for_team(int vehicles) {
    if (vehicles >= 1000) return {1, 5, 2};
    if (vehicles >= 100) return {1, 5, 8};
    return vehicles >= 10 ? Plan{3, 2, 20} : Plan{10, 2, 20};
  }
  double simulated() const { return 1e-3 * City::interval * intervals * (turns + 1); }  ///< s in each city
};

/// What was seen of an engine.
struct Record {
  std::vector<double> rates;  ///< vehicle-steps/s of each turn
  double distance = 0;        ///< m, driven by a vehicle in a city, on average
  double height = 0;          ///< m, on average after each turn

  double rate() const {
    std::vector<double> sorted = rates;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// A team on its way through a city.
class Drive {
 public:
  Drive(const City& city, const Engine& engine) : city_(city), team_(engine.make(city)) {
    for (const Pose& p : city.starts()) last_.push_back(p.position);
  }
  /// Drives for some intervals; returns the wall-clock time in s.
  double turn(int intervals) {
    const auto start = std::chrono::steady_clock::now();
    for (int end = next_ + intervals; next_ < end; ++next_) {
      for (int v = 0; v < city_.vehicles(); ++v)
        if (city_.changes(v, next_)) team_->command(v, city_.command(v, next_));
      team_->run(City::interval);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  /// Mean way (m) since the last look, and mean height (m).
  std::pair<double, double> look() {
    double way = 0, height = 0;
    for (std::size_t v = 0; v < last_.size(); ++v) {
      const Vec3 now = team_->pose(int(v)).position;
      way += (now - last_[v]).norm();
      height += now.z();
      last_[v] = now;
    }
    return {way / double(last_.size()), height / double(last_.size())};
  }

 private:
  const City& city_;
  std::unique_ptr<Team> team_;
  std::vector<Vec3> last_;
  int next_ = 0;
};

/// All engines take turns.
std::vector<Record> compare(int vehicles, const Plan& plan, const std::vector<Engine>& engines) {
  std::vector<Record> records(engines.size());
  for (int c = 0; c < plan.cities; ++c) {
    const City city(vehicles, std::uint64_t(c + 1));
    std::vector<Drive> drives;
    for (const Engine& e : engines) drives.emplace_back(city, e);
    for (int turn = 0; turn <= plan.turns; ++turn)
      for (std::size_t e = 0; e < engines.size(); ++e) {
        const double wall = drives[e].turn(plan.intervals);
        const auto [way, height] = drives[e].look();
        Record& r = records[e];
        r.distance += way / plan.cities;
        if (turn == 0) continue;
        r.rates.push_back(double(vehicles) * City::interval * plan.intervals / wall);
        r.height += height / (plan.cities * plan.turns);
      }
  }
  return records;
}

Engine muro_with(int threads) {
  return {fmt::format("muro, {} thread{}", threads, threads > 1 ? "s" : ""), true,
          [threads](const City& city) { return std::make_unique<MuroTeam>(city, threads, Wheels::balls); }};
}
/// The others have balls as wheels.
Engine muro_with_cylinders() {
  return {"muro, wheels as cylinders", true,
          [](const City& city) { return std::make_unique<MuroTeam>(city, 1, Wheels::cylinders); }};
}

const char* level(const Engine& e) { return e.one_body ? "one body" : "five bodies"; }

void compare_with_peers(Report& report, const std::vector<int>& teams, const std::vector<Engine>& engines) {
  for (const int vehicles : teams) {
    const Plan plan = Plan::for_team(vehicles);
    const std::vector<Record> records = compare(vehicles, plan, engines);
    report.table(fmt::format("N = {}, {} x {:.1f} s at 1000 Hz", vehicles, plan.cities, plan.simulated()),
                 {"engine", "a vehicle is", "vehicle-steps/s", "slowest turn", "fastest turn", "muro is faster by",
                  "driven, m", "height, m"});
    const auto is_muro = [](const Engine& e) { return e.name.starts_with("muro"); };
    const double own = is_muro(engines.front()) ? records.front().rate() : 0;
    double best = 0, articulated = 0;
    for (std::size_t e = 0; e < engines.size(); ++e) {
      const Record& r = records[e];
      const auto [slowest, fastest] = std::minmax_element(r.rates.begin(), r.rates.end());
      report.row({engines[e].name, level(engines[e]), whole(r.rate()), whole(*slowest), whole(*fastest),
                  own > 0 ? Cell(fixed(own / r.rate(), 1)) : Cell(""), fixed(r.distance, 2), fixed(r.height, 4)});
      if (own == 0 || is_muro(engines[e])) continue;
      if (engines[e].one_body) best = std::max(best, r.rate());
      if (engines[e].name == "ODE, articulated") articulated = r.rate();
    }
    const bool large = vehicles >= 100;
    if (best > 0)
      report.ratio(fmt::format("N = {}: steps of vehicles, muro to the best peer with one body", vehicles), own / best,
                   large ? "at least 12" : "");
    if (articulated > 0)
      report.ratio(fmt::format("N = {}: steps of vehicles, muro to articulated ODE", vehicles), own / articulated,
                   large ? "at least 25" : "");
  }
}

/// muro alone: what a vehicle costs in teams of all sizes, on one thread and on two.
void compare_sizes(Report& report) {
  report.table("muro alone, 4 s at 1000 Hz", {"vehicles", "1 thread, vehicle-steps/s", "ns a vehicle and step",
                                              "2 threads, vehicle-steps/s", "2 threads to 1"});
  const std::vector<Engine> engines = {muro_with(1), muro_with(2)};
  double of_twenty = 0;
  for (const int vehicles : {1, 3, 10, 20, 50, 100, 300, 1000}) {
    const std::vector<Record> r = compare(vehicles, Plan{vehicles < 100 ? 10 : 3, 3, 10}, engines);
    const double cost = 1e9 / r[0].rate();
    if (vehicles == 20) of_twenty = cost;
    if (vehicles == 1000) report.ratio("cost of a vehicle among 1000 to among 20", cost / of_twenty, "at most 1.3");
    const double gain = r[1].rate() / r[0].rate();
    report.row({vehicles, whole(r[0].rate()), whole(cost), whole(r[1].rate()), fixed(gain, 2)});
    report.ratio(fmt::format("N = {}: two threads to one", vehicles), gain,
                 vehicles == 1000  ? "at least 1.8"
                 : vehicles == 100 ? "at least 1.7"
                                   : "at least 1");
  }
}

}  // namespace

int main(int argc, char** argv) {
  Report report("vehicles", "Vehicles in the city: muro and other engines", argc, argv);
  std::vector<Engine> engines = {muro_with(1), muro_with(2), muro_with_cylinders()};
  for (Engine& e : peers()) engines.push_back(std::move(e));
  const std::string only = report.argument("only", "");
  std::erase_if(engines, [&](const Engine& e) { return e.name.find(only) == std::string::npos; });

  const int one = std::stoi(report.argument("vehicles", "0"));
  compare_with_peers(report, one > 0 ? std::vector{one} : std::vector{1, 10, 100, 1000}, engines);
  if (one == 0 && only.empty()) compare_sizes(report);
  report.note("Bullet 3.24, ODE 0.16 and MuJoCo 2.2 are Debian's, in double precision.");
  report.finish();
  return 0;
}
