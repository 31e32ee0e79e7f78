// SPDX-License-Identifier: MIT
// Measures how many humanoids motion.biped walks in real time on one thread: robots of 21 joints, 100 steps of the
// motion a second, each robot at another phase of its walk. Targets are set between steps, outside of the measured
// time.
//   --robots N     number of robots, 1000 by default
//   --seconds S    simulated in each round, 2 by default
#include <fmt/format.h>

#include <chrono>

#include "muro/base/elementary.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/scene.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr int rate = 100, rounds = 7;                                         // Hz of the motion
constexpr double step_of_legs = 0.4, swing = 0.25, crouch = 0.6, lift = 0.5;  // s, rad

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Humanoids : public test::Scene {
 public:
  Humanoids(int count, bool with_links) {
    add_ground();
    const RobotTree model = read_model(MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf");
    const int side = int(std::ceil(std::sqrt(count)));
    for (int i = 0; i < count; ++i) {
      const int row = i / side;
      add(std::to_string(i), model, {{1.0 * (i % side), 1.0 * row, model.standing_height()}, Quat::Identity()});
    }
    use("motion.biped", rate, all_robots(), {{"feet", std::vector<std::string>{"l_foot_link", "r_foot_link"}}});
    if (with_links) use("kinematics.direct", rate, all_robots());
    set_threads(1);
    build();
    for (const RobotView* r : world().robots())
      for (const char* joint : {"l_hip_pitch", "l_knee", "l_ank_pitch", "r_hip_pitch", "r_knee", "r_ank_pitch"})
        targets_.push_back(&world().value(std::string(r->name) + "/" + joint, keys::joint_position_target));
    walk(2);
  }
  /// Walks for `seconds` of simulated time; returns the time that the steps have taken (s).
  double walk(double seconds) {
    double taken = 0;
    for (long k = 0; k < std::lround(seconds * rate); ++k) {
      command(double(++steps_) / rate);
      const double start = wall_clock();
      run_for(1.0 / rate);
      taken += wall_clock() - start;
    }
    return taken;
  }
  double mean_way() {
    double sum = 0;
    for (const RobotView* r : world().robots())
      sum += (pose(*r).position - world().value(r->base(), keys::initial_pose).position).head<2>().norm();
    return sum / double(world().robots().size());
  }

 private:
  void command(double t) {
    const std::size_t count = targets_.size() / 6;
    for (std::size_t i = 0; i < count; ++i) {
      const double phase = t / step_of_legs + double(i) / double(count) * 2, done = std::floor(phase);
      for (const bool left : {true, false}) {
        const bool stands = left == (std::fmod(done, 2) == 0);
        const double leg = swing * (stands ? 1 : -1) * (2 * (phase - done) - 1);
        const double bend = crouch + (stands ? 0 : lift * elementary::sin(M_PI * (phase - done)));
        double* const* const q = &targets_[6 * i + (left ? 0 : 3)];
        *q[0] = leg - 0.5 * bend, *q[1] = bend, *q[2] = -leg - 0.5 * bend;
      }
    }
  }

  std::vector<double*> targets_;
  std::int64_t steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Report report("biped", "Humanoids that walk by motion.biped", argc, argv);
  const int count = std::stoi(report.argument("robots", "1000"));
  const double seconds = std::stod(report.argument("seconds", "2"));
  report.table(fmt::format("{} humanoids of 21 joints at {} Hz, 1 thread, {} s in each of {} rounds", count, rate,
                           seconds, rounds),
               {"algorithms", "humanoids in real time", "slowest round", "us a humanoid and step", "walked, m"});
  for (const bool with_links : {false, true}) {
    Humanoids all(count, with_links);
    std::vector<double> taken;
    for (int i = 0; i < rounds; ++i) taken.push_back(all.walk(seconds));
    const auto [best, worst] = std::minmax_element(taken.begin(), taken.end());
    const double in_real_time = count * seconds / *best;
    report.row({with_links ? "motion.biped, kinematics.direct" : "motion.biped", whole(in_real_time),
                whole(count * seconds / *worst), fixed(1e6 * *best / (count * seconds * rate), 3),
                fixed(all.mean_way(), 2)});
    report.ratio(with_links ? "humanoids in real time on one core, with the poses of all links"
                            : "humanoids in real time on one core",
                 in_real_time, "at least 1000, aim 5000");
  }
  report.finish();
  return 0;
}
