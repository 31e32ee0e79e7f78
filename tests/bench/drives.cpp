// SPDX-License-Identifier: MIT
#include "tests/bench/drives.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tests/bench/report.hpp"

namespace muro::bench {

namespace {

/// A team on its way through a city.
class Drive {
 public:
  Drive(const City& city, const Engine& engine, Effort effort) : city_(city), team_(engine.make(city, effort)) {
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
  Vec3 position(int vehicle) const { return team_->pose(vehicle).position; }

 private:
  const City& city_;
  std::unique_ptr<Team> team_;
  std::vector<Vec3> last_;
  int next_ = 0;
};

}  // namespace

double Record::rate() const { return median(rates); }

double Record::gain(const Record& other) const {
  std::vector<double> ratios;
  for (std::size_t t = 0; t < rates.size(); ++t) ratios.push_back(rates[t] / other.rates[t]);
  return median(ratios);
}

std::vector<Record> compare(const Plan& plan, const std::vector<Engine>& engines,
                            const std::function<City(std::uint64_t seed)>& make_city) {
  std::vector<Record> records(engines.size());
  const int drives_in_all = plan.cities * plan.repeats;
  for (int d = 0; d < drives_in_all; ++d) {
    const City city = make_city(std::uint64_t(d / plan.repeats + 1));
    const auto first = std::size_t(d / plan.repeats * plan.turns);  // turn of this city
    std::vector<Drive> drives;
    for (const Engine& e : engines) drives.emplace_back(city, e, e.effort);
    for (int turn = 0; turn <= plan.turns; ++turn)
      for (std::size_t e = 0; e < engines.size(); ++e) {
        const double wall = drives[e].turn(plan.intervals);
        const auto [way, height] = drives[e].look();
        Record& r = records[e];
        r.distance += way / drives_in_all;
        if (turn == 0) continue;
        r.rates.resize(first + std::size_t(plan.turns));
        double& rate = r.rates[first + std::size_t(turn - 1)];
        rate = std::max(rate, double(engines[e].teams * city.vehicles()) * City::interval * plan.intervals / wall);
        r.height += height / (drives_in_all * plan.turns);
      }
  }
  return records;
}

Deviation deviation(const Engine& engine) {
  constexpr int vehicles = 10, intervals = 6000 / City::interval;
  const int cities = engine.one_body ? 3 : 1;  // the others take long
  Deviation d;
  for (int c = 0; c < cities; ++c) {
    const City city = City::open(vehicles, std::uint64_t(c + 1));
    Drive usual(city, engine, engine.effort), converged(city, engine, Effort::converged());
    usual.turn(intervals);
    converged.turn(intervals);
    for (int v = 0; v < vehicles; ++v) {
      const double away = (usual.position(v) - converged.position(v)).norm();
      d.rms += away * away / (cities * vehicles);
      d.most = std::max(d.most, away);
    }
  }
  d.rms = std::sqrt(d.rms);
  return d;
}

}  // namespace muro::bench
