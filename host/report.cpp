// SPDX-License-Identifier: MIT
#include "host/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/instance.hpp"
#include "host/shadows.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

const Pose& base_pose(const Simulation& s, const RobotView& robot) { return s.world().value(robot.base(), keys::pose); }

double ms_per_simulated_s(const Simulation& s, std::size_t instance, double simulated) {
  const TaskCost& cost = s.scheduler().cost(s.task_of(instance));
  return simulated > 0 ? 1e3 * double(cost.ticks) * s.scheduler().seconds_per_tick() / simulated : 0;
}

/// As it is scheduled: in a sequence it may be another than the scenario asks for.
Rate rate_of(const Simulation& s, std::size_t instance) { return s.scheduler().tasks()[s.task_of(instance)].rate; }

bool is_finite(const Pose& p) { return p.position.allFinite() && p.orientation.coeffs().allFinite(); }

/// A file appears under its name when it is complete.
std::string part_of(const std::string& path) { return path + ".part"; }
std::ofstream open_part(const std::string& path) { return std::ofstream(part_of(path), std::ios::binary); }

SetupError unwritable(const std::string& path) {
  return SetupError("file " + path + " cannot be written; is the folder there, may you write to it, is there room?");
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

void Odometer::check() const {
  for (const RobotView* r : simulation_.world().robots())
    if (!is_finite(base_pose(simulation_, *r)))
      throw StepError(
          fmt::format("the pose of robot `{}` is not a number any more at t = {:g} s; try a higher "
                      "rate of its motion, or weaker forces",
                      r->name, 1e-9 * double(simulation_.now())));
}

nlohmann::ordered_json report(const RunResult& run, const Simulation& simulation, const Odometer& odometer) {
  nlohmann::ordered_json out;
  out["scenario"] = run.scenario;
  out["seed"] = run.seed;
  out["threads"] = simulation.scheduler().executor().threads();
  out["simulated_s"] = run.simulated;
  out["wall_s"] = run.wall;
  out["real_time_factor"] = run.wall > 0 ? run.simulated / run.wall : 0;
  out["state_hash"] = fmt::format("{:016x}", simulation.state_hash());
  out["interrupted"] = run.interrupted;
  if (!run.error.empty()) out["error"] = run.error;
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
  for (const ShadowResult& s : shadow_results(simulation))
    out["shadows"].push_back({{"robot", s.robot},
                              {"motion", s.motion},
                              {"distance_m", s.distance},
                              {"angle_rad", s.angle},
                              {"greatest_distance_m", s.greatest_distance},
                              {"greatest_angle_rad", s.greatest_angle}});
  auto& algorithms = out["algorithms"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < simulation.instances().size(); ++i) {
    const AlgorithmSetup& s = simulation.instances()[i]->setup();
    const double ms = ms_per_simulated_s(simulation, i, run.simulated);
    nlohmann::ordered_json a = {{"name", s.name}, {"plugin", s.use}};
    const Rate rate = rate_of(simulation, i);
    a["rate_hz"] = rate.on_demand() ? nlohmann::ordered_json("on_demand") : nlohmann::ordered_json(rate.hertz());
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

void write_file(const std::string& path, const std::string& text) {
  namespace fs = std::filesystem;
  std::ofstream out = open_part(path);
  out << text;
  out.close();
  std::error_code code;
  if (out) fs::rename(part_of(path), path, code);
  if (!out || code) {
    fs::remove(part_of(path), code);
    throw unwritable(path);
  }
}

void check_writable(const std::string& path) {
  std::error_code code;
  const bool fine = !std::filesystem::is_directory(path, code) && open_part(path).good();
  std::filesystem::remove(part_of(path), code);
  if (!fine) throw unwritable(path);
}

}  // namespace muro::host
