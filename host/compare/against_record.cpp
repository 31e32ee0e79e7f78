// SPDX-License-Identifier: MIT
#include "host/compare/against_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/output_registry.hpp"
#include "host/names.hpp"
#include "host/outputs/remove_outputs.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::host {

namespace {

/// What the record commands, where the scenario takes it.
class RecordedCommands {
 public:
  RecordedCommands(Simulation& simulation, const std::string& joint)
      : goal_(find(simulation, joint, "joint.position.target")),
        supply_voltage_(find(simulation, joint, "servo.supply_voltage")),
        torque_enable_(find(simulation, joint, "servo.torque_enable")),
        p_gain_(find(simulation, joint, "servo.p_gain")) {
    if (!goal_)
      throw SetupError(in_backquotes(joint) +
                       " follows no positions; give its robot a servo (motor.servo), or `joints: position`");
  }
  void set(const RecordSample& s, double p_gain) const {
    *goal_ = s.goal;
    if (supply_voltage_ && s.supply_voltage > 0) *supply_voltage_ = s.supply_voltage;
    if (torque_enable_) *torque_enable_ = s.torque_enable ? 1 : 0;
    if (p_gain_ && p_gain > 0) *p_gain_ = p_gain;
  }
  bool can_disable() const { return torque_enable_ != nullptr; }

 private:
  static double* find(Simulation& simulation, const std::string& joint, const char* key) {
    World& world = simulation.world();
    const ObjectId object = world.object(joint);
    if (!world.store().find(object, key)) return nullptr;
    return &world.value(object, Key<double>{key, "", ""});
  }
  double *goal_, *supply_voltage_, *torque_enable_, *p_gain_;
};

std::int64_t whole_ns(double seconds) { return std::llround(seconds * 1e9); }

void follow_record(Simulation& simulation, const std::string& joint, const MotorRecord& record,
                   RecordDeviation& result) {
  const RecordedCommands commands(simulation, joint);
  World& world = simulation.world();
  double& position = world.value(joint, keys::joint_position);
  position = record.samples.front().position;
  double squares = 0;
  const auto start = std::chrono::steady_clock::now();
  const double begin = record.samples.front().time;
  bool has_torque_off = false;
  for (std::size_t i = 0; i + 1 < record.samples.size() && !simulation.stopped(); ++i) {
    const RecordSample& next = record.samples[i + 1];
    has_torque_off = has_torque_off || !record.samples[i].torque_enable;
    commands.set(record.samples[i], record.p_gain);
    simulation.run_until(whole_ns(next.time - begin));
    const double error = position - next.position;
    result.residuals.times.push_back(next.time);
    result.residuals.errors.push_back(error);
    result.error.mean += std::abs(error);
    squares += error * error;
    result.error.largest = std::max(result.error.largest, std::abs(error));
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double count = double(std::max<std::size_t>(result.residuals.errors.size(), 1));
  result.error.mean /= count;
  result.error.rms = std::sqrt(squares / count);
  result.cost = wall / std::max(record.samples.back().time - begin, 1e-9);
  if (has_torque_off && !commands.can_disable())
    result.notes.push_back(record.name + ": in it the torque is off for a while, which " + in_backquotes(joint) +
                           " cannot do here; a motor driven by a voltage can (motor.servo with `part` or `kt`)");
}

std::string record_name(const MotorRecord& r) { return std::filesystem::path(r.name).filename().string(); }

}  // namespace

std::string joint_to_compare(Simulation& simulation, const std::string& wanted) {
  std::vector<std::string> all;
  const World& world = simulation.world();
  for (const RobotView* r : world.robots())
    for (const Link& link : r->links)
      if (link.joint != JointKind::fixed && link.mimic < 0) all.emplace_back(world.object_name(link.joint_object));
  if (wanted.empty() && all.size() == 1) return all.front();
  if (wanted.empty())
    throw SetupError("--against needs --joint ROBOT/JOINT: the joint that was recorded; there are: " +
                     comma_separated(all));
  if (std::find(all.begin(), all.end(), wanted) == all.end())
    throw SetupError("--joint " + in_backquotes(wanted) + ": there is no such joint" + suggestion(wanted, all));
  return wanted;
}

RecordDeviation run_against(const Comparison& comparison, const Variation& variation, const std::string& joint,
                            const MotorRecord& record, Registry& registry,
                            const std::function<void(LogLevel, std::string_view)>& log) {
  RecordDeviation result;
  result.label = variation.label;
  try {
    const BuiltScenario built =
        build(read_variation(comparison, variation.overrides, registry), registry, [&](Simulation& simulation) {
          simulation.set_log(log);
          simulation.keep_inputs_closed();
          add_outputs(simulation, comparison.outputs);
        });
    built.simulation->set_threads(1);
    result.notes = built.notes;
    follow_record(*built.simulation, joint_to_compare(*built.simulation, joint), record, result);
  } catch (const OutputError&) {
    throw;
  } catch (const std::exception& e) {
    result.failure = e.what();
  }
  return result;
}

std::string record_table(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations) {
  std::size_t wide = 6;
  for (const RecordDeviation& d : deviations) wide = std::max(wide, d.label.size());
  std::string text;
  const std::size_t variations = deviations.size() / records.size();
  std::vector<RecordError> sums(variations);
  std::vector<std::size_t> counts(variations);
  const auto row = [&](const std::string& label, const RecordError& e, const std::string& cost) {
    text +=
        fmt::format("  {:<{}}  {:>14.4f}  {:>9.4f}  {:>9.4f}  {:>12}\n", label, wide, e.mean, e.rms, e.largest, cost);
  };
  const std::string head =
      fmt::format("  {:<{}}  {:>14}  {:>9}  {:>9}  {:>12}\n", "", wide, "mean |error|", "RMS", "largest", "cost, s/s");
  for (std::size_t i = 0; i < records.size(); ++i) {
    text += fmt::format("{}, P gain {:g}: simulated minus recorded position, rad\n{}", record_name(records[i]),
                        records[i].p_gain, head);
    for (std::size_t v = 0; v < variations; ++v) {
      const RecordDeviation& d = deviations[i * variations + v];
      if (!d.failure.empty()) {
        text += fmt::format("  {:<{}}  did not run: {}\n", d.label, wide, d.failure);
        continue;
      }
      row(d.label, d.error, fmt::format("{:.2g}", d.cost));
      sums[v].mean += d.error.mean, sums[v].rms += d.error.rms * d.error.rms;
      sums[v].largest = std::max(sums[v].largest, d.error.largest);
      ++counts[v];
    }
  }
  if (records.size() < 2) return text;
  text += fmt::format("all {} records\n{}", records.size(), head);
  for (std::size_t v = 0; v < variations; ++v) {
    if (counts[v] == 0) continue;
    sums[v].mean /= double(counts[v]), sums[v].rms = std::sqrt(sums[v].rms / double(counts[v]));
    row(deviations[v].label, sums[v], "");
  }
  return text;
}

std::string record_csv(const std::vector<MotorRecord>& records, const std::vector<RecordDeviation>& deviations) {
  std::string text = "record,p_gain,variation,mean_error,rms_error,largest_error,cost,failure\n";
  const std::size_t variations = deviations.size() / records.size();
  const auto quoted = [](std::string cell) {
    std::replace(cell.begin(), cell.end(), '\n', ' ');
    for (std::size_t at = 0; (at = cell.find('"', at)) != std::string::npos; at += 2) cell.insert(at, 1, '"');
    return '"' + cell + '"';
  };
  for (std::size_t k = 0; k < deviations.size(); ++k) {
    const RecordDeviation& d = deviations[k];
    const MotorRecord& r = records[k / variations];
    const std::string figures = d.failure.empty() ? fmt::format("{:.6g},{:.6g},{:.6g},{:.6g}", d.error.mean,
                                                                d.error.rms, d.error.largest, d.cost)
                                                  : ",,,";
    text += fmt::format("{},{:g},{},{},{}\n", quoted(r.name), r.p_gain, quoted(d.label), figures, quoted(d.failure));
  }
  return text;
}

}  // namespace muro::host
