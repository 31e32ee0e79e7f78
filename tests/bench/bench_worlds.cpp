// SPDX-License-Identifier: MIT
// Cost that muro adds to an engine: scenes that one world of motion.bullet, motion.ode or motion.mujoco moves, compared
// with raw programs of these engines with the same scene, commands, rate and iterations, alternately in one run.
//   --vehicles N   only this number of vehicles
#include <fmt/format.h>

#include <algorithm>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"
#include "tests/bench/team_runs.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

using Parameters = std::map<std::string, ParameterInput>;

/// Returns the parameters with which a motion equals the raw program of its engine (tests/bench/baselines).
Parameters parameters_of(const std::string& motion, SolverSettings e) {
  const std::int64_t iterations = e.iterations;
  if (motion == "motion.mujoco")
    return {{"solver", std::string("cg")},
            {"iterations", iterations},
            {"tolerance", 1e-5},
            {"refinements", std::int64_t(0)},
            {"several_contacts", false}};
  if (motion == "motion.ode")
    return {{"solver", std::string("quick")}, {"iterations", iterations}, {"reactions", false}};
  return {{"iterations", iterations}};
}

Engine by_muro(const std::string& motion, SolverSettings settings) {
  return {.name = fmt::format("muro, {}, {} iterations", motion, settings.iterations),
          .make =
              [motion](const City& city, SolverSettings e) {
                return std::make_unique<MuroTeam>(
                    city, 1, Wheels::balls,
                    MotionSetup{motion, 1000 * e.steps, parameters_of(motion, e), false, false});
              },
          .settings = settings};
}

std::string motion_for(const Engine& raw) {
  return raw.name.starts_with("ODE")      ? "motion.ode"
         : raw.name.starts_with("Bullet") ? "motion.bullet"
                                          : "motion.mujoco";
}

bool is_offered(const std::string& motion) {
  for (const CatalogEntry& o : test::plugins().catalog())
    if (o.id == motion) return true;
  return false;
}

/// Adds raw ODE with the default iterations of motion.ode, as raw programs have only as many as driving needs.
void add_default_of_ode(std::vector<Engine>& raw) {
  const auto last = std::find_if(raw.rbegin(), raw.rend(), [](const Engine& e) { return e.name.starts_with("ODE"); });
  if (last == raw.rend()) return;
  Engine usual = *last;
  usual.name = "ODE, articulated, 50 iterations";
  usual.settings.iterations = 50;
  raw.insert(last.base(), usual);
}

}  // namespace

int main(int argc, char** argv) {
  Report report("worlds", "What muro adds to an engine", argc, argv);
  const int one = std::stoi(report.argument("vehicles", "0"));
  std::vector<Engine> raw = baselines();
  std::erase_if(raw, [](const Engine& e) { return e.one_body || !is_offered(motion_for(e)); });
  add_default_of_ode(raw);
  for (const int vehicles : one > 0 ? std::vector{one} : std::vector{1, 10, 50}) {
    report.table(fmt::format("{} vehicles in the city", vehicles),
                 {"engine", "vehicle-steps/s", "us a vehicle and step", "distance, m", "height, m"});
    for (const Engine& engine : raw) {
      const std::vector<Engine> pair{engine, by_muro(motion_for(engine), engine.settings)};
      const std::vector<Measurement> r =
          compare(RunPlan::for_team(vehicles), pair, [=](std::uint64_t seed) { return City(vehicles, seed); });
      for (std::size_t k = 0; k < pair.size(); ++k)
        report.row({pair[k].name, whole(r[k].rate()), fixed(1e6 / r[k].rate(), 2), fixed(r[k].distance, 3),
                    fixed(r[k].height, 4)});
      report.ratio(fmt::format("N = {}: cost of {} to {}", vehicles, pair[1].name, engine.name),
                   1 / r[1].ratio_to(r[0]), "at most 1.1");
    }
  }
  report.note(
      "The raw programs: tests/bench/baselines. Bullet's is of rigid bodies and hinges; motion.bullet moves trees of "
      "links in reduced coordinates, which is another solver.");
  report.finish();
  return 0;
}
