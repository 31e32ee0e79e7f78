// SPDX-License-Identifier: MIT
#include "host/outputs/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/external/input_log.hpp"
#include "core/external/reported_numbers.hpp"
#include "core/instance.hpp"
#include "host/outputs/libraries.hpp"
#include "host/scenario/shadows.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::host {

namespace {

using Json = nlohmann::ordered_json;

double ms_per_simulated_s(const Simulation& s, std::size_t instance, double simulated) {
  const Task::Cost& cost = s.scheduler().cost(s.task_of(instance));
  return simulated > 0 ? 1e3 * double(cost.ticks) * s.scheduler().seconds_per_tick() / simulated : 0;
}

/// Returns the scheduled rate; in a sequence it may differ from the rate in the scenario.
Rate rate_of(const Simulation& s, std::size_t instance) { return s.scheduler().tasks()[s.task_of(instance)].rate; }

/// Whether the same state, parameters and seed always give the same results.
bool is_deterministic(const Instance& instance) {
  return (instance.description().capabilities & Capability::deterministic) != 0;
}

}  // namespace

std::vector<std::string> nondeterministic_algorithms(const Simulation& simulation) {
  std::vector<std::string> all;
  for (const auto& instance : simulation.instances())
    if (const std::string& id = instance->setup().use;
        !is_deterministic(*instance) && std::find(all.begin(), all.end(), id) == all.end())
      all.push_back(id);
  return all;
}

namespace {

Json robots_report(const Simulation& simulation, const Odometer& odometer) {
  Json all = Json::array();
  for (const RobotView* r : simulation.world().robots()) {
    const Pose& p = base_pose(simulation, *r);
    all.push_back({{"name", r->name},
                   {"distance_m", odometer.distance(index_of(r->id))},
                   {"position_m", {p.position.x(), p.position.y(), p.position.z()}},
                   {"yaw_rad", yaw_of(p.orientation)},
                   {"state_hash", fmt::format("{:016x}", simulation.world().hash(*r))}});
  }
  return all;
}

/// Reports the bins up to the last one that is not 0.
Json pacing_report(const Lateness& late) {
  Json histogram = Json::array();
  std::size_t last = Lateness::bins;
  while (last > 0 && late.histogram[last - 1] == 0) --last;
  for (std::size_t bin = 0; bin < last; ++bin)
    histogram.push_back({{"below_s", bin + 1 < Lateness::bins ? Json(Lateness::upper_end(bin)) : Json(nullptr)},
                         {"instants", late.histogram[bin]}});
  return {{"instants", late.instants},          {"overruns", late.overruns},
          {"mean_lateness_s", late.mean()},     {"p99_lateness_s", late.quantile(0.99)},
          {"longest_lateness_s", late.longest}, {"histogram", histogram}};
}

Json algorithms_report(const RunResult& run, const Simulation& simulation) {
  Json all = Json::array();
  for (std::size_t i = 0; i < simulation.instances().size(); ++i) {
    const Instance& instance = *simulation.instances()[i];
    const AlgorithmSetup& s = instance.setup();
    const double ms = ms_per_simulated_s(simulation, i, run.simulated);
    const Rate rate = rate_of(simulation, i);
    all.push_back({{"name", s.name},
                   {"plugin", s.use},
                   {"deterministic", is_deterministic(instance)},
                   {"rate_hz", rate.on_demand() ? Json("on_demand") : Json(rate.hertz())},
                   {"steps", simulation.scheduler().cost(simulation.task_of(i)).runs},
                   {"items", s.items.size()},
                   {"ms_per_simulated_s", ms},
                   {"ms_per_simulated_s_per_item", ms / double(s.items.size())}});
  }
  return all;
}

/// Whole numbers have no decimal point, as long as they are exact.
Json json_number(double value) {
  constexpr double exact = 9007199254740992;  // 2^53
  if (std::abs(value) < exact && value == std::floor(value)) return std::int64_t(value);
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Adds the numbers of algorithms: a section of maps, one for each name. Sections of the host itself are not changed.
void add_numbers(const ReportedNumbers& told, Json& out) {
  for (const auto& [section, all] : told.sections()) {
    if (out.contains(section)) continue;
    for (const auto& [name, numbers] : all) {
      Json entry = {{"name", name}};
      for (const auto& [key, value] : numbers) entry[key] = json_number(value);
      out[section].push_back(std::move(entry));
    }
  }
}

}  // namespace

Json report(const RunResult& run, const Simulation& simulation, const Odometer& odometer) {
  Json out;
  out["scenario"] = run.scenario;
  out["seed"] = run.seed;
  out["threads"] = simulation.scheduler().executor().threads();
  out["simulated_s"] = run.simulated;
  out["wall_s"] = run.wall;
  out["real_time_factor"] = run.wall > 0 ? run.simulated / run.wall : 0;
  out["state_hash"] = fmt::format("{:016x}", simulation.state_hash());
  out["nondeterministic_algorithms"] = nondeterministic_algorithms(simulation);
  out["interrupted"] = run.interrupted;
  if (!run.error.empty()) out["error"] = run.error;
  out["overruns"] = simulation.scheduler().pacer().lateness().overruns;
  if (const Lateness& late = simulation.scheduler().pacer().lateness(); late.instants > 0)
    out["pacing"] = pacing_report(late);
  out["external_inputs"] = {{"count", simulation.inputs().count()},
                            {"replayed", simulation.inputs().has_recording()},
                            {"not_repeatable", simulation.inputs().reasons()}};
  out["robots"] = robots_report(simulation, odometer);
  for (const ShadowResult& s : shadow_results(simulation))
    out["shadows"].push_back({{"robot", s.robot},
                              {"motion", s.motion},
                              {"distance_m", s.distance},
                              {"angle_rad", s.angle},
                              {"max_distance_m", s.max_distance},
                              {"max_angle_rad", s.max_angle}});
  out["algorithms"] = algorithms_report(run, simulation);
  out["libraries"] = libraries_report(simulation);
  add_numbers(simulation.reported_numbers(), out);
  return out;
}

std::string profile(const RunResult& run, const Simulation& simulation) {
  std::vector<std::size_t> order(simulation.instances().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto ms = [&](std::size_t i) { return ms_per_simulated_s(simulation, i, run.simulated); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ms(a) > ms(b); });
  double total = 0;
  for (const std::size_t i : order) total += ms(i);
  std::string out = fmt::format("{:<28} {:<28} {:>10} {:>10} {:>6} {:>12} {:>12} {:>6}\n", "algorithm", "plugin",
                                "rate/Hz", "steps", "items", "ms/sim. s", "us/item run", "share");
  for (const std::size_t i : order) {
    const AlgorithmSetup& s = simulation.instances()[i]->setup();
    const std::uint64_t runs = simulation.scheduler().cost(simulation.task_of(i)).runs;
    const Rate rate = rate_of(simulation, i);
    const double per_item = runs > 0 ? 1e3 * ms(i) * run.simulated / double(runs) / double(s.items.size()) : 0;
    out += fmt::format("{:<28} {:<28} {:>10} {:>10} {:>6} {:>12.3f} {:>12.3f} {:>5.1f}%\n", s.name, s.use,
                       rate.on_demand() ? "on demand" : fmt::format("{:g}", rate.hertz()), runs, s.items.size(), ms(i),
                       per_item, total > 0 ? 100 * ms(i) / total : 0);
  }
  return out;
}

}  // namespace muro::host
