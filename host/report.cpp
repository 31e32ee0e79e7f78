// SPDX-License-Identifier: MIT
#include "host/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/instance.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

const Pose& base_pose(const Simulation& s, const RobotView& robot) { return s.world().value(robot.base(), keys::pose); }

double ms_per_simulated_s(const Simulation& s, std::size_t instance, double simulated) {
  const TaskCost& cost = s.scheduler().cost(s.task_of(instance));
  return simulated > 0 ? 1e3 * double(cost.ticks) * s.scheduler().seconds_per_tick() / simulated : 0;
}

}  // namespace

Odometer::Odometer(const Simulation& simulation) : simulation_(simulation) {
  for (const RobotView* r : simulation.world().robots()) last_.push_back(base_pose(simulation, *r).position);
  distances_.assign(last_.size(), 0);
}

void Odometer::sample() {
  for (const RobotView* r : simulation_.world().robots()) {
    const Vec3& now = base_pose(simulation_, *r).position;
    distances_[r->number] += (now - last_[r->number]).norm();
    last_[r->number] = now;
  }
}

nlohmann::ordered_json report(const RunResult& run, const Simulation& simulation, const Odometer& odometer) {
  nlohmann::ordered_json out;
  out["scenario"] = run.scenario;
  out["seed"] = run.seed;
  out["threads"] = 1;
  out["simulated_s"] = run.simulated;
  out["wall_s"] = run.wall;
  out["real_time_factor"] = run.wall > 0 ? run.simulated / run.wall : 0;
  out["state_hash"] = fmt::format("{:016x}", simulation.state_hash());
  out["interrupted"] = run.interrupted;
  out["overruns"] = simulation.scheduler().overruns();
  auto& robots = out["robots"] = nlohmann::ordered_json::array();
  for (const RobotView* r : simulation.world().robots()) {
    const Pose& p = base_pose(simulation, *r);
    robots.push_back({{"name", r->name},
                      {"distance_m", odometer.distance(r->number)},
                      {"position_m", {p.position.x(), p.position.y(), p.position.z()}},
                      {"yaw_rad", yaw_of(p.orientation)},
                      {"state_hash", fmt::format("{:016x}", simulation.world().hash(*r))}});
  }
  auto& algorithms = out["algorithms"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < simulation.instances().size(); ++i) {
    const AlgorithmSetup& s = simulation.instances()[i]->setup();
    const double ms = ms_per_simulated_s(simulation, i, run.simulated);
    nlohmann::ordered_json a = {{"name", s.name}, {"plugin", s.use}};
    a["rate_hz"] = s.rate.on_demand() ? nlohmann::ordered_json("on_demand") : nlohmann::ordered_json(s.rate.hertz());
    a["steps"] = simulation.scheduler().cost(simulation.task_of(i)).runs;
    a["items"] = s.items.size();
    a["ms_per_simulated_s"] = ms;
    a["ms_per_simulated_s_per_item"] = ms / double(s.items.size());
    algorithms.push_back(std::move(a));
  }
  return out;
}

std::string profile(const RunResult& run, const Simulation& simulation) {
  std::vector<std::size_t> order(simulation.instances().size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto ms = [&](std::size_t i) { return ms_per_simulated_s(simulation, i, run.simulated); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ms(a) > ms(b); });
  double total = 0;
  for (const std::size_t i : order) total += ms(i);
  std::string out = fmt::format("{:<28} {:<28} {:>10} {:>10} {:>6} {:>12} {:>12} {:>6}\n", "algorithm", "plugin", "rate/Hz", "steps",
                                "items", "ms/sim. s", "us/item run", "share");
  for (const std::size_t i : order) {
    const AlgorithmSetup& s = simulation.instances()[i]->setup();
    const std::uint64_t runs = simulation.scheduler().cost(simulation.task_of(i)).runs;
    const double per_item = runs > 0 ? 1e3 * ms(i) * run.simulated / double(runs) / double(s.items.size()) : 0;
    out += fmt::format("{:<28} {:<28} {:>10} {:>10} {:>6} {:>12.3f} {:>12.3f} {:>5.1f}%\n", s.name, s.use,
                       s.rate.on_demand() ? "on demand" : fmt::format("{:g}", s.rate.hertz()), runs, s.items.size(), ms(i), per_item,
                       total > 0 ? 100 * ms(i) / total : 0);
  }
  return out;
}

void write_file(const std::string& path, const std::string& text) {
  namespace fs = std::filesystem;
  const std::string part = path + ".part";
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  std::error_code code;
  if (out) fs::rename(part, path, code);
  if (!out || code) {
    fs::remove(part, code);
    throw SetupError("file " + path + " cannot be written; is the folder there, may you write to it, is there room?");
  }
}

}  // namespace muro::host
