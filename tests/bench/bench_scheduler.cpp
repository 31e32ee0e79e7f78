// SPDX-License-Identifier: MIT
// Cost of the scheduler and of the property store alone: of algorithms that do nothing, and of reading a property of
// every robot, compared with a plain array of structs.
#include <chrono>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr int turns = 15;

template <class Work>
double seconds(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Robots without shapes, each with an empty algorithm at 1000 Hz.
std::unique_ptr<Simulation> empty_team(Registry& registry, int robots, bool batched, int threads) {
  auto simulation = std::make_unique<Simulation>(registry);
  const RobotTree body = test::tree_of([](RobotBuilder& b) { b.base("body"); });
  for (int i = 0; i < robots; ++i) {
    const RobotView& r = simulation->world().add_robot(std::to_string(i), body);
    AlgorithmSetup setup;
    setup.name = batched ? "team" : std::string(r.name);
    setup.use = setup.subsystem = batched ? "bench.empty_batch" : "bench.empty";
    setup.rate = Rate(1000);
    setup.items = {{&r, r.base()}};
    simulation->add(std::move(setup));
  }
  simulation->set_threads(unsigned(threads));
  simulation->build();
  return simulation;
}

void empty_algorithms(Report& report) {
  report.table("An empty algorithm at 1000 Hz, ns of wall-clock time",
               {"robots", "instances", "threads", "an instant", "a robot and step"});
  Registry registry({MURO_BENCH_PLUGIN_DIR});
  for (const bool batched : {false, true})
    for (const int robots : {1, 10, 100, 1000})
      for (const int threads : {1, 2}) {
        const auto simulation = empty_team(registry, robots, batched, threads);
        const int instants = batched ? 20'000 : 200'000 / robots;
        simulation->run_for(1e-3 * instants);
        std::vector<double> costs;
        for (int t = 0; t < turns; ++t)
          costs.push_back(1e9 / instants * seconds([&] { simulation->run_for(1e-3 * instants); }));
        const double instant = median(costs);
        report.row({robots, batched ? 1 : robots, threads, fixed(instant, 1), fixed(instant / robots, 2)});
        if (!batched && robots >= 100 && threads == 1)
          report.ratio("N = " + std::to_string(robots) + ": an empty algorithm, ns a step", instant / robots,
                       "at most 50");
      }
}

/// State of a robot in a program without properties.
struct PlainRobot {
  Pose pose;
  Twist twist;
  double wheel_positions[4] = {}, wheel_velocities[4] = {};
};

/// Hides a value from the optimiser.
void use(const Vec3& value) { asm volatile("" : : "r"(&value) : "memory"); }

void property_access(Report& report) {
  const Vec3 point(0.1, 0.02, 0.03);
  report.table("Placing a point of every robot in the world by its pose, ns a robot",
               {"robots", "property", "array of structs", "ratio"});
  for (const int robots : {10, 100, 1000, 10000}) {
    CityScene scene{City(robots)};
    scene.use("motion.point", 1000, scene.all_robots());
    scene.build();
    std::vector<In<Pose>> handles;
    std::vector<PlainRobot> plain;
    for (const RobotView* r : scene.world().robots()) {
      handles.emplace_back(&scene.pose(*r));
      plain.emplace_back().pose = scene.pose(*r);
    }
    const int rounds = 4'000'000 / robots;
    std::vector<double> of_property, of_struct;
    for (int t = 0; t < turns; ++t) {
      of_property.push_back(seconds([&] {
        for (int k = 0; k < rounds; ++k) {
          Vec3 sum = Vec3::Zero();
          for (const In<Pose>& pose : handles) sum += *pose * point;
          use(sum);
        }
      }));
      of_struct.push_back(seconds([&] {
        for (int k = 0; k < rounds; ++k) {
          Vec3 sum = Vec3::Zero();
          for (const PlainRobot& r : plain) sum += r.pose * point;
          use(sum);
        }
      }));
    }
    const double reads = double(rounds) * robots, ratio = median(of_property) / median(of_struct);
    report.row({robots, fixed(1e9 * median(of_property) / reads, 3), fixed(1e9 * median(of_struct) / reads, 3),
                fixed(ratio, 2)});
    if (robots >= 100)
      report.ratio("N = " + std::to_string(robots) + ": reading a property to an array of structs", ratio,
                   "at most 1.2");
  }
}

}  // namespace

int main(int argc, char** argv) {
  Report report("scheduler", "Costs of the scheduler and of properties", argc, argv);
  empty_algorithms(report);
  property_access(report);
  report.finish();
  return 0;
}
