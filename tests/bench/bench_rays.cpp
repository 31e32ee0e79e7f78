// SPDX-License-Identifier: MIT
// Rays per second: a scanner on every vehicle of the city, in muro (laser.raycast with scene.bvh), Embree and Bullet.
// All scan the same scene, update included, and run alternately in one process.
//   --pattern 682x1   only this pattern
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr int rounds = 5;
constexpr double min_round = 0.03;  // s of wall-clock time
constexpr double max_time = 1.5;    // s of wall-clock time, after which an engine has no more rounds

struct Case {
  Pattern pattern;
  double range;
  int vehicles;
  bool moving;
  double rays() const { return double(pattern.size()) * vehicles; }
};

/// Ranges and speed of an engine.
class Runner {
 public:
  Runner(const RayEngine& engine, const City& city, const Case& c)
      : city_(city), case_(c), scanners_(engine.make(city, c.pattern, c.range)) {
    drive(city, 0, poses_);
    scanners_->scan(poses_, true);
    first_.resize(std::size_t(c.rays()));
    for (int v = 0; v < c.vehicles; ++v)
      for (int i = 0; i < c.pattern.size(); ++i)
        first_[std::size_t(v * c.pattern.size() + i)] = float(scanners_->range(v, i));
  }

  void run_round() {
    if (total_ > max_time) return;
    double wall = 0;
    int scans = 0;
    while (wall < min_round) {
      if (case_.moving) drive(city_, 0.1 * ++scan_, poses_);
      const auto start = std::chrono::steady_clock::now();
      scanners_->scan(poses_, case_.moving);
      wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      ++scans;
    }
    total_ += wall;
    rates_.push_back(case_.rays() * scans / wall);
  }
  double rate() const {
    std::vector<double> sorted = rates_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
  /// Returns the mean range of the first scan.
  double mean_range() const {
    double sum = 0;
    for (const float r : first_) sum += double(r);
    return sum / case_.rays();
  }
  double fraction_of_hits() const {
    return double(std::count_if(first_.begin(), first_.end(), [&](float r) { return r < float(case_.range); })) /
           case_.rays();
  }
  /// Returns the fraction of rays whose range differs by more than 5 mm.
  double differs_from(const Runner& other) const {
    int n = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) n += std::abs(first_[i] - other.first_[i]) > 5e-3f;
    return n / case_.rays();
  }

 private:
  const City& city_;
  const Case& case_;
  std::unique_ptr<Scanners> scanners_;
  std::vector<Pose> poses_;
  std::vector<float> first_;
  std::vector<double> rates_;
  double total_ = 0;
  int scan_ = 0;
};

void compare(Report& report, const Case& c, const std::vector<RayEngine>& engines) {
  const City city(c.vehicles);
  std::vector<std::optional<Runner>> runners;
  for (const RayEngine& e : engines)
    if (e.max_rays >= c.rays())
      runners.emplace_back(std::in_place, e, city, c);
    else
      runners.emplace_back();
  for (int t = 0; t < rounds; ++t)
    for (std::optional<Runner>& r : runners)
      if (r) r->run_round();
  const Runner& own = *runners.front();
  std::vector<Cell> row = {c.pattern.name(), c.range, c.vehicles};
  double embree = 0, differs = 0;
  for (std::size_t e = 0; e < engines.size(); ++e) {
    row.push_back(runners[e] ? Cell(fixed(1e-6 * runners[e]->rate(), 2)) : Cell(""));
    if (!runners[e]) continue;
    if (engines[e].embree) embree = std::max(embree, runners[e]->rate());
    differs = std::max(differs, runners[e]->differs_from(own));
  }
  row.insert(row.end(), {embree > 0 ? Cell(fixed(own.rate() / embree, 2)) : Cell(""), fixed(own.mean_range(), 3),
                         fixed(100 * own.fraction_of_hits(), 1), fixed(100 * differs, 3)});
  report.row(row);
  if (!c.moving) return;
  const std::string what = fmt::format("{} rays, {} m, {} vehicles: ", c.pattern.name(), c.range, c.vehicles);
  if (embree > 0)
    report.ratio(what + "muro to Embree", own.rate() / embree, c.pattern.size() < 100 ? "at least 1.2" : "at least 2");
  report.ratio(what + "two threads to one", runners[1]->rate() / own.rate(), "at least 1");
}

RayEngine muro_with(int threads) {
  return {fmt::format("muro, {} thread{}", threads, threads > 1 ? "s" : ""), false,
          [threads](const City& city, const Pattern& pattern, double range) {
            return std::make_unique<MuroScanners>(city, pattern, range, threads);
          }};
}

}  // namespace

int main(int argc, char** argv) {
  Report report("rays", "Rays of laser scanners: muro and other engines", argc, argv);
  std::vector<RayEngine> engines = {muro_with(1), muro_with(2)};
  for (RayEngine& e : ray_baselines()) engines.push_back(std::move(e));
  const std::string only = report.argument("pattern", "");

  std::vector<std::string> columns = {"rays", "range, m", "vehicles"};
  for (const RayEngine& e : engines) columns.push_back(e.name);
  columns.insert(columns.end(), {"muro to Embree", "mean range, m", "hits, %", "rays that differ, %"});
  for (const bool moving : {true, false}) {
    report.table(moving ? "Vehicles move between passes, update included; million rays per second"
                        : "Nothing moves; million rays per second",
                 columns);
    for (const double range : {5.6, 30.0})
      for (const int vehicles : {10, 100})
        for (const auto& [across, rows] : {std::pair{10, 1}, {100, 1}, {682, 1}, {100, 10}, {100, 100}, {1024, 64}}) {
          const Case c{Pattern(across, rows), range, vehicles, moving};
          if (!only.empty() && c.pattern.name() != only) continue;
          if (!moving && vehicles != 10) continue;
          compare(report, c, engines);
        }
  }
  report.note("Embree 3.13 and Bullet 3.24 are Debian's; Embree traces in single precision.");
  report.finish();
  return 0;
}
