// SPDX-License-Identifier: MIT
#include "tests/bench/team_runs.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/bench/report.hpp"

namespace muro::bench {

namespace {

/// A run of a team through a city.
class TeamRun {
 public:
  TeamRun(const City& city, const Engine& engine, SolverSettings settings)
      : city_(city), team_(engine.make(city, settings)) {
    for (const Pose& p : city.starts()) last_.push_back(p.position);
  }
  /// Runs for some intervals; returns the wall-clock time in s.
  double run(int intervals) {
    const auto start = std::chrono::steady_clock::now();
    for (int end = next_ + intervals; next_ < end; ++next_) {
      for (int v = 0; v < city_.vehicles(); ++v)
        if (city_.changes(v, next_)) team_->command(v, city_.command(v, next_));
      team_->run(City::interval);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  /// Returns the mean distance since the last call, and the mean height, m.
  std::pair<double, double> distance_and_height() {
    double distance = 0, height = 0;
    for (std::size_t v = 0; v < last_.size(); ++v) {
      const Vec3 now = team_->pose(int(v)).position;
      distance += (now - last_[v]).norm();
      height += now.z();
      last_[v] = now;
    }
    return {distance / double(last_.size()), height / double(last_.size())};
  }
  Vec3 position(int vehicle) const { return team_->pose(vehicle).position; }

 private:
  const City& city_;
  std::unique_ptr<Team> team_;
  std::vector<Vec3> last_;
  int next_ = 0;
};

}  // namespace

double Measurement::rate() const { return median(rates); }

double Measurement::ratio_to(const Measurement& other) const {
  std::vector<double> ratios;
  for (std::size_t t = 0; t < rates.size(); ++t) ratios.push_back(rates[t] / other.rates[t]);
  return median(ratios);
}

std::vector<Measurement> compare(const RunPlan& plan, const std::vector<Engine>& engines,
                                 const std::function<City(std::uint64_t seed)>& make_city) {
  std::vector<Measurement> measurements(engines.size());
  const int runs_in_all = plan.cities * plan.repeats;
  for (int d = 0; d < runs_in_all; ++d) {
    const City city = make_city(std::uint64_t(d / plan.repeats + 1));
    const auto first = std::size_t(d / plan.repeats * plan.rounds);  // round of this city
    std::vector<TeamRun> runs;
    for (const Engine& e : engines) runs.emplace_back(city, e, e.settings);
    for (int round = 0; round <= plan.rounds; ++round)
      for (std::size_t e = 0; e < engines.size(); ++e) {
        const double wall = runs[e].run(plan.intervals);
        const auto [distance, height] = runs[e].distance_and_height();
        Measurement& m = measurements[e];
        m.distance += distance / runs_in_all;
        if (round == 0) continue;
        m.rates.resize(first + std::size_t(plan.rounds));
        double& rate = m.rates[first + std::size_t(round - 1)];
        rate = std::max(rate, double(engines[e].teams * city.vehicles()) * City::interval * plan.intervals / wall);
        m.height += height / (runs_in_all * plan.rounds);
      }
  }
  return measurements;
}

Deviation deviation(const Engine& engine) {
  constexpr int vehicles = 10, intervals = 6000 / City::interval;
  const int cities = engine.one_body ? 3 : 1;  // the others take a long time
  Deviation d;
  for (int c = 0; c < cities; ++c) {
    const City city = City::open(vehicles, std::uint64_t(c + 1));
    TeamRun usual(city, engine, engine.settings), converged(city, engine, SolverSettings::converged());
    usual.run(intervals);
    converged.run(intervals);
    for (int v = 0; v < vehicles; ++v) {
      const double away = (usual.position(v) - converged.position(v)).norm();
      d.rms += away * away / (cities * vehicles);
      d.max = std::max(d.max, away);
    }
  }
  d.rms = std::sqrt(d.rms);
  return d;
}

}  // namespace muro::bench
