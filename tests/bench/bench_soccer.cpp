// SPDX-License-Identifier: MIT
// The two scenes of examples/soccer: teams of humanoids that see and walk by motion.biped, compared with the figure of
// the MuRoSimF group, and 22 humanoids moved by forces at 1000 Hz. Fails if a robot falls or does not move its joints,
// or if the ball is not kicked.
//   --rounds N     measurements of each row, of which the best counts, 5 by default
//   --cameras no   leaves the first scene out, which takes minutes without a GPU
#include <fmt/format.h>

#include <chrono>
#include <map>
#include <utility>

#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/scene.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

using Overrides = std::vector<std::string>;

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool is_ball(const RobotView& robot) { return robot.name == "ball"; }

class Game {
 public:
  Game(const std::string& file, Overrides overrides, unsigned threads)
      : built_(host::build(host::read_scenario(MURO_TEST_SOURCE_DIR "/examples/soccer/" + file,
                                               with_threads(std::move(overrides), threads)),
                           test::plugins())) {
    for (const RobotView* r : world().robots())
      for (const Link& link : r->links)
        if (!is_ball(*r) && link.joint != JointKind::fixed) joints_.push_back({link.joint_object, 1e9, -1e9});
  }

  /// Simulates `seconds`; returns the wall-clock time that this took (s).
  double run(double seconds) {
    const double start = wall_clock();
    simulation().run_for(seconds);
    const double taken = wall_clock() - start;
    watch();
    return taken;
  }

  std::size_t humanoids() const { return world().robots().size() - 1; }
  /// Returns the mean over the humanoids of the largest motion of one of their joints, rad.
  double moved() const {
    double sum = 0, most = 0;
    const std::size_t of_each = joints_.size() / humanoids();
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      most = std::max(most, joints_[i].most - joints_[i].least);
      if ((i + 1) % of_each == 0) sum += std::exchange(most, 0);
    }
    return sum / double(humanoids());
  }
  double lowest() const { return lowest_; }      ///< m, of any trunk
  double highest() const { return highest_; }    ///< m
  double steepest() const { return steepest_; }  ///< cosine of the largest tilt
  double ball() const { return world().value("ball/body", keys::pose).position.head<2>().norm(); }
  /// Returns the mean distance of humanoids from their starts, m.
  double way() const {
    double sum = 0;
    for (const RobotView* r : world().robots())
      if (!is_ball(*r))
        sum += (pose(*r).position - world().value(r->base(), keys::initial_pose).position).head<2>().norm();
    return sum / double(humanoids());
  }
  /// Returns ms per simulated second, by algorithm, in all runs so far.
  std::map<std::string, double> costs(double simulated) const {
    std::map<std::string, double> all;
    for (std::size_t i = 0; i < built_.simulation->instances().size(); ++i) {
      const Scheduler& scheduler = built_.simulation->scheduler();
      const Task::Cost cost = scheduler.cost(built_.simulation->task_of(i));
      all[built_.simulation->instances()[i]->setup().use] +=
          1e3 * double(cost.ticks) * scheduler.seconds_per_tick() / simulated;
    }
    return all;
  }

 private:
  struct Range {
    ObjectId joint;
    double least, most;
  };

  static Overrides with_threads(Overrides overrides, unsigned threads) {
    overrides.push_back("threads=" + std::to_string(threads));
    return overrides;
  }
  Simulation& simulation() { return *built_.simulation; }
  const World& world() const { return built_.simulation->world(); }
  const Pose& pose(const RobotView& r) const { return world().value(r.base(), keys::pose); }

  void watch() {
    for (const RobotView* r : world().robots()) {
      if (is_ball(*r)) continue;
      lowest_ = std::min(lowest_, pose(*r).position.z());
      highest_ = std::max(highest_, pose(*r).position.z());
      steepest_ = std::min(steepest_, (pose(*r).orientation * Vec3::UnitZ()).z());
    }
    for (Range& j : joints_) {
      const double q = world().value(j.joint, keys::joint_position);
      j.least = std::min(j.least, q);
      j.most = std::max(j.most, q);
    }
  }

  host::BuiltScenario built_;
  std::vector<Range> joints_;
  double lowest_ = 1e9, highest_ = -1e9, steepest_ = 1;
};

class SoccerBench {
 public:
  SoccerBench(Report& report, int rounds) : report_(report), rounds_(rounds) {}

  /// Measures twenty humanoids that walk and see.
  void cameras() {
    report_.table("Humanoids of 21 joints that walk by motion.biped, each with a camera of 320 x 240 at 20 Hz",
                  {"who", "humanoids", "cameras", "threads", "times real time", "humanoids in real time", "images/s",
                   "walked, m"});
    report_.row({"MuRoSimF 2007, a standard laptop", 10, "20 Hz, size not told", "", 1, 10, 200, ""});
    const Overrides with_shadows = {"robots.blue.camera.shadows=true", "robots.red.camera.shadows=true"};
    const Overrides blind = {"robots.blue.camera=off", "robots.red.camera=off"};
    cameras_row("no", blind, 1, 2);
    cameras_row("yes, with shadows", with_shadows, 1, 0.15);
    const double factor = cameras_row("yes", {}, 1, 0.15);
    report_.ratio("twenty humanoids with a camera each: x real time", factor, "ten at 1 in 2007");
    report_.ratio("humanoids with a camera each in real time, to the ten of 2007", 20 * factor / 10);
    report_.note(
        "MuRoSimF 2007: up to 10 humanoids of 21 joints with a camera of 20 frames per second each, in real time by "
        "kinematic motion on a standard laptop (page of MuRoSimF at dribblers.de, with the poster of the RoboCup "
        "Symposium 2007; Section 5.1 of the paper names this simulation without figures). Its pictures were drawn by "
        "OpenGL (Section 4); without a GPU muro's are drawn by the processor.");
  }

  /// Measures eleven humanoids a side.
  void game() {
    report_.table("22 humanoids of two teams and a ball by motion.articulated, 1000 Hz, all shapes collide, 2 s",
                  {"threads", "times real time", "slowest round", "us a humanoid and ms", "trunks, m",
                   "joints move, rad", "ball, m", "all stand"});
    std::map<std::string, double> costs;
    for (const unsigned threads : {1u, 2u}) {
      std::vector<double> taken;
      bool sound = true;
      double low = 1e9, high = -1e9, moved = 0, ball = 0;
      for (int i = 0; i < rounds_; ++i) {
        Game g("soccer.yaml", {}, threads);
        double sum = 0;
        for (int k = 0; k < 20; ++k) sum += g.run(0.1);
        taken.push_back(sum);
        low = std::min(low, g.lowest()), high = std::max(high, g.highest()), moved = g.moved(), ball = g.ball();
        sound = sound && stands(g);
        if (threads == 1 && sum <= *std::min_element(taken.begin(), taken.end())) costs = g.costs(simulated);
      }
      const auto [best, worst] = std::minmax_element(taken.begin(), taken.end());
      const double factor = simulated / *best;
      report_.row({threads, fixed(factor, 1), fixed(simulated / *worst, 1), fixed(1e6 / (factor * 22 * 1000), 3),
                   fmt::format("{:.3f} to {:.3f}", low, high), fixed(moved, 2), fixed(ball, 2), sound ? "yes" : "no"});
      report_.ratio(
          fmt::format("22 humanoids of two teams on {}: x real time", threads == 1 ? "one core" : "two cores"), factor,
          threads == 1 ? "at least 20" : "");
    }
    double all = 0;
    for (const auto& [name, cost] : costs) all += cost;
    report_.table("The same by algorithm, one thread, the best round", {"algorithm", "ms per simulated s", "share, %"});
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, cost] : costs) order.emplace_back(cost, name);
    std::sort(order.rbegin(), order.rend());
    for (const auto& [cost, name] : order) report_.row({name, fixed(cost, 2), fixed(100 * cost / all, 1)});
  }

  const std::string& failures() const { return failures_; }

 private:
  static constexpr double simulated = 2;  // s

  double cameras_row(const std::string& cameras, const Overrides& overrides, unsigned threads, double seconds) {
    double best = 1e9, way = 0;
    for (int i = 0; i < 2; ++i) {
      Game g("cameras.yaml", overrides, threads);
      g.run(0.05);  // warm: textures and meshes have reached the renderer
      best = std::min(best, g.run(seconds));
      way = g.way();
      if (g.lowest() < 0.2 || g.highest() > 0.29) failures_ += "motion.biped: a humanoid does not stand\n";
    }
    const double factor = seconds / best;
    report_.row({"muro", 20, cameras, threads, fixed(factor, 3), fixed(20 * factor, 1),
                 cameras == "no" ? Cell("") : Cell(fixed(factor * 400, 1)), fixed(way, 3)});
    return factor;
  }

  bool stands(const Game& g) {
    std::string wrong;
    if (g.lowest() < 0.2 || g.highest() > 0.29 || g.steepest() < 0.9) wrong += " a humanoid fell;";
    if (g.moved() < 0.2) wrong += " joints do not move;";
    if (g.ball() < 0.2) wrong += " the ball is not kicked;";
    if (!wrong.empty()) failures_ += "motion.articulated:" + wrong + "\n";
    return wrong.empty();
  }

  Report& report_;
  int rounds_;
  std::string failures_;
};

}  // namespace

int main(int argc, char** argv) {
  Report report("soccer", "Teams of humanoids on the field", argc, argv);
  SoccerBench bench(report, std::stoi(report.argument("rounds", "5")));
  if (report.argument("cameras", "yes") == "yes") bench.cameras();
  bench.game();
  report.finish();
  if (bench.failures().empty()) return 0;
  std::fprintf(stderr, "bench_soccer:\n%s", bench.failures().c_str());
  return 1;
}
