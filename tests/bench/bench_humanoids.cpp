// SPDX-License-Identifier: MIT
// Steps of humanoids with 21 servos: motions of muro, and raw MuJoCo and Bullet with the same masses, servos, rotors
// and shapes, all at 1000 Hz, alternately in one run; and rovers beside articulated ODE. Fails if a humanoid falls,
// sinks, or does not follow its servos. MURO_ISA=avx2 or base in the environment selects narrower vectors.
//   --robots N        only this number of robots
//   --motions A,B     motions of muro; the first is compared with the others. Motions that are not built are left out
//   --peers_up_to N   other engines, and motions but the first, have no more robots than this (50)
//   --rovers no       only humanoids
#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <map>
#include <sstream>

#include "muro/simd/isa.hpp"
#include "tests/bench/muro_humanoids.hpp"
#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/team_runs.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr int bus_period = 8;  ///< ms, in which servos get new targets
constexpr int settling = 400;  ///< ms, before times are taken
constexpr int rounds = 15;
/// s: shortest turn of an engine. It is so long that what other engines have left in caches is a small part of it.
constexpr double least_turn = 5e-3;
constexpr double most_sunk = 0.03;   ///< m, of a trunk below the height that its legs give it
constexpr double most_behind = 0.3;  ///< rad, of a knee from its target
constexpr const char* mujoco = "MuJoCo";
constexpr const char* bullet = "Bullet";

/// A way to move the humanoids.
struct Mover {
  std::string name;
  std::function<std::unique_ptr<Humanoids>(const HumanoidScene&)> make;
  std::string family;  ///< `mujoco`, `bullet`, or a motion of muro
  unsigned threads = 1;
};

/// Humanoids at their exercise.
class Run {
 public:
  Run(const HumanoidScene& scene, Exercise exercise, const Mover& mover)
      : robots_(scene.robots()),
        exercise_(exercise),
        squat_(scene.bodies),
        hinges_(scene.hinges()),
        humanoids_(mover.make(scene)) {}

  /// Runs for some periods of the servos' bus, and for more until `least` (s) are over. Returns ns a robot and step, of
  /// the engine alone.
  double run(int periods, double least = 0) {
    double wall = 0;
    int done = 0;
    for (; done < periods || wall < least; ++done, time_ += bus_period) {
      for (std::size_t r = 0; r < robots_; ++r) {
        squat_.set(Squat::bend(exercise_, r, time_), hinges_);
        humanoids_->command(r, hinges_);
      }
      const auto start = std::chrono::steady_clock::now();
      humanoids_->run(bus_period);
      wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    watch();
    return 1e9 * wall / (double(done) * bus_period * double(robots_));
  }
  double low() const { return low_; }  ///< m, of trunks, since the robots have settled
  double high() const { return high_; }
  /// Returns the fault of the robots, or "" if there is none.
  const std::string& failure() const { return failure_; }

 private:
  void watch() {
    if (time_ < settling / 2) return;
    for (std::size_t r = 0; r < robots_; ++r) {
      const Pose trunk = humanoids_->trunk(r);
      const double z = trunk.position.z(), bend = Squat::bend(exercise_, r, time_ - bus_period);
      const double upright = (trunk.orientation * Vec3::UnitZ()).z();
      const double behind = humanoids_->position(r, squat_.knee()) - 2 * bend;
      low_ = std::min(low_, z);
      high_ = std::max(high_, z);
      const bool stands = std::abs(z - squat_.height(bend)) <= most_sunk && upright > 0.95;
      if (failure_.empty() && !(stands && std::abs(behind) <= most_behind))
        failure_ =
            fmt::format("robot {} after {} ms: trunk {:.3f} m high for {:.3f}, {:.2f} upright, knee {:.2f} rad off", r,
                        time_, z, squat_.height(bend), upright, behind);
    }
  }

  std::size_t robots_;
  Exercise exercise_;
  Squat squat_;
  std::vector<double> hinges_;
  std::unique_ptr<Humanoids> humanoids_;
  int time_ = 0;  ///< ms
  double low_ = INFINITY, high_ = -INFINITY;
  std::string failure_;
};

/// Returns the fastest use of MuJoCo with one world for all or a world for each: solver, dense or sparse. Large worlds
/// are tried with fewer, as time and memory of the others grow with the cube and the square of their robots.
Mover best_mujoco(const HumanoidScene& scene, Exercise exercise, bool world_each) {
  const bool large = scene.robots() > 20 && !world_each;
  Mover best;
  double least = INFINITY;
  for (const char* solver : {"CG", "Newton", "PGS"})
    for (const char* jacobian : {"sparse", "dense"}) {
      if (large && (std::string_view(jacobian) == "dense" || std::string_view(solver) == "PGS")) continue;
      const MujocoUse use{solver, jacobian, world_each};
      Mover m{fmt::format("{}, {}, {}, {}", mujoco, world_each ? "a world for each" : "one world", solver, jacobian),
              [use](const HumanoidScene& s) { return mujoco_humanoids(s, use); }, mujoco};
      Run run(scene, exercise, m);
      run.run(2);
      const double cost = std::min(run.run(1), run.run(1));
      if (cost >= least) continue;
      least = cost;
      best = std::move(m);
    }
  return best;
}

std::vector<Mover> peers(const HumanoidScene& scene, Exercise exercise) {
  std::vector<Mover> all;
#ifdef MURO_BENCH_MUJOCO
  all.push_back(best_mujoco(scene, exercise, true));
  if (scene.robots() > 1) all.push_back(best_mujoco(scene, exercise, false));
#endif
#ifdef MURO_BENCH_BULLET
  for (const int directions : {1, 2})
    all.push_back({fmt::format("{}, friction along {} direction{}", bullet, directions, directions > 1 ? "s" : ""),
                   [directions](const HumanoidScene& s) { return bullet_humanoids(s, directions); }, bullet});
#endif
  return all;
}

/// Least ratios of the speed of muro to that of MuJoCo and Bullet, for one robot and for more.
struct Bars {
  int one_mujoco, one_bullet, mujoco, bullet;
};
std::string bar(int times) { return fmt::format("at least {}", times); }

class HumanoidBench {
 public:
  HumanoidBench(Report& report, std::vector<std::string> motions, std::size_t peers_up_to)
      : report_(report), motions_(std::move(motions)), peers_up_to_(peers_up_to) {}

  void compare(std::size_t robots, Exercise exercise) {
    const HumanoidScene scene = humanoid_scene(robots, exercise);
    const std::vector<Mover> movers = movers_for(scene, exercise);
    std::vector<Run> runs;
    for (const Mover& m : movers) {
      runs.emplace_back(scene, exercise, m);
      for (int p = 0; p < settling / bus_period; ++p) runs.back().run(1);
    }
    std::vector<double> costs(runs.size(), INFINITY);
    const int periods = std::max(1, int(40 / robots));
    for (int k = 0; k < rounds; ++k)
      for (std::size_t i = 0; i < runs.size(); ++i) costs[i] = std::min(costs[i], runs[i].run(periods, least_turn));
    tell(robots, exercise, movers, runs, costs);
  }
  const std::string& failures() const { return failures_; }

 private:
  std::vector<Mover> movers_for(const HumanoidScene& scene, Exercise exercise) const {
    std::vector<Mover> movers;
    for (const std::string& motion : motions_)
      for (const unsigned threads : {1u, 2u}) {
        const bool is_first = motion == motions_.front();
        if (!is_first && (threads > 1 || scene.robots() > peers_up_to_)) continue;
        movers.push_back({fmt::format("{}, {} thread{}", motion, threads, threads > 1 ? "s" : ""),
                          [motion, threads](const HumanoidScene& s) { return muro_humanoids(s, motion, threads); },
                          motion, threads});
      }
    if (scene.robots() > peers_up_to_) return movers;
    for (Mover& m : peers(scene, exercise)) movers.push_back(std::move(m));
    return movers;
  }

  void tell(std::size_t robots, Exercise exercise, const std::vector<Mover>& movers, const std::vector<Run>& runs,
            const std::vector<double>& costs) {
    const char* const what = exercise == Exercise::standing ? "stand" : "squat";
    const std::string& own = motions_.front();
    report_.table(
        fmt::format("N = {}: humanoids {}, 1000 Hz; the least of {} rounds", robots, what, rounds),
        {"engine", "ns a robot and step", own + " is faster by", "trunks, lowest, m", "highest, m", "stands"});
    std::map<std::string, double> least;  // of one thread, by family
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const std::string& failure = runs[i].failure();
      report_.row({movers[i].name, whole(costs[i]), fixed(costs[i] / costs[0], 2), fixed(runs[i].low(), 4),
                   fixed(runs[i].high(), 4), failure.empty() ? "yes" : "no"});
      if (!failure.empty()) failures_ += fmt::format("N = {}, {}, {}: {}\n", robots, what, movers[i].name, failure);
      double& cost = least.try_emplace(movers[i].family, INFINITY).first->second;
      if (movers[i].threads == 1) cost = std::min(cost, costs[i]);
    }
    const bool has_bars = own == "motion.articulated" && exercise == Exercise::squatting;
    const auto ratio = [&](const char* peer, int one, int many) {
      if (least.count(peer) != 0)
        report_.ratio(fmt::format("N = {}, {}: steps of humanoids, {} to the best of {}", robots, what, own, peer),
                      least[peer] / least[own], has_bars ? bar(robots == 1 ? one : many) : "");
    };
    const Bars b = bars();
    ratio(mujoco, b.one_mujoco, b.mujoco);
    ratio(bullet, b.one_bullet, b.bullet);
    if (robots < 1000) return;
    report_.ratio(fmt::format("{} humanoids {} at 1000 Hz on one core: x real time", robots, what),
                  1e9 / (least[own] * double(robots) * 1000), has_bars ? "at least 1" : "");
    report_.ratio(fmt::format("N = {}, {}: two threads to one", robots, what), costs[0] / costs[1]);
  }

  static Bars bars() {
    switch (lane::best_isa()) {
      case lane::Isa::avx512:
        return {5, 8, 30, 50};
      case lane::Isa::avx2:
        return {5, 8, 20, 30};
      default:
        return {5, 8, 10, 15};
    }
  }

  Report& report_;
  std::vector<std::string> motions_;
  std::size_t peers_up_to_;
  std::string failures_;
};

bool is_built(const std::string& motion) {
  const auto& all = test::plugins().catalog();
  return std::any_of(all.begin(), all.end(), [&](const CatalogEntry& e) { return e.id == motion; });
}

/// Compares rovers in the city, whose wheels are balls, with articulated ODE.
void compare_rovers(Report& report, const std::string& motion) {
  std::vector<Engine> engines;
  engines.push_back({motion + ", 1 thread", false, [&](const City& city, SolverSettings) {
                       return std::make_unique<MuroTeam>(city, 1, Wheels::balls, MotionSetup{.motion = motion});
                     }});
  for (Engine& e : baselines())
    if (e.name.starts_with("ODE, articulated")) engines.push_back(std::move(e));
  for (const int rovers : {100, 1000}) {
    const RunPlan plan = RunPlan::for_team(rovers);
    const std::vector<Measurement> all =
        compare(plan, engines, [rovers](std::uint64_t seed) { return City(rovers, seed); });
    report.table(fmt::format("{} rovers in the city, {:.1f} s at 1000 Hz", rovers, plan.simulated()),
                 {"engine", "ns a rover and step", motion + " is faster by", "driven, m", "height, m"});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double times = all[0].rate() / all[i].rate();
      report.row({engines[i].name, whole(1e9 / all[i].rate()), fixed(times, 2), fixed(all[i].distance, 2),
                  fixed(all[i].height, 4)});
      if (i > 0)
        report.ratio(fmt::format("{} rovers: steps, {} to {}", rovers, motion, engines[i].name), times,
                     engines[i].name.find("10") != std::string::npos ? "at least 30, better 60" : "");
    }
  }
}

/// Returns the exit code.
int run_benchmark(int argc, char** argv) {
  Report report("humanoids", "Humanoids: muro and other engines", argc, argv);
  std::vector<std::string> motions;
  std::istringstream names(report.argument("motions", "motion.articulated,motion.mujoco,motion.bullet"));
  for (std::string name; std::getline(names, name, ',');) {
    if (is_built(name))
      motions.push_back(name);
    else
      report.note(fmt::format("{} is not built and left out.", name));
  }
  if (motions.empty()) throw std::runtime_error("no motion of --motions is built");
  HumanoidBench bench(report, motions, std::stoul(report.argument("peers_up_to", "50")));
  const std::size_t one = std::stoul(report.argument("robots", "0"));
  for (const Exercise exercise : {Exercise::standing, Exercise::squatting})
    for (const std::size_t robots : one > 0 ? std::vector{one} : std::vector<std::size_t>{1, 20, 50, 1000})
      bench.compare(robots, exercise);
  if (report.argument("rovers", "yes") == "yes") compare_rovers(report, motions.front());
  report.note("MuJoCo 2.2 and Bullet 3.24 are Debian's, in double precision, with 4 iterations.");
  report.finish();
  if (bench.failures().empty()) return 0;
  std::fprintf(stderr, "bench_humanoids: robots that do not stand:\n%s", bench.failures().c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_benchmark(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "bench_humanoids: %s\n", e.what());
    return 2;
  }
}
