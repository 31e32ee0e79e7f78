// SPDX-License-Identifier: MIT
#include "host/tools/compare/against_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/instance.hpp"
#include "core/output_registry.hpp"
#include "host/names.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::host {

namespace {

/// The commands of a record, for those that the scenario takes.
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
    return world.find_value(object, Key<double>{key, "", ""});
  }
  double *goal_, *supply_voltage_, *torque_enable_, *p_gain_;
};

std::int64_t whole_ns(double seconds) { return std::llround(seconds * 1e9); }

/// The joint at any time of the simulation, as its servo measures it. Its motion computes it at instants; between them
/// it is interpolated.
class SimulatedJoint {
 public:
  SimulatedJoint(Simulation& simulation, const std::string& joint)
      : simulation_(simulation), position_(simulation.world().value(joint, keys::joint_position)) {
    World& world = simulation.world();
    const ObjectId object = world.object(joint);
    velocity_ = world.find_value(object, keys::joint_velocity);
    constexpr Key<double> offset{"servo.offset", "", ""};
    offset_ = world.value(object, offset, offset_);
    const Slot* slot = world.store().find(object, keys::joint_position.name);
    const Slot::User* writer = slot ? slot->writer() : nullptr;
    for (const auto& instance : simulation.instances())
      if (writer && instance->accessor() == writer->accessor)
        rate_ = instance->setup().rate, phase_ = instance->setup().phase;
  }

  /// Puts the joint at the measured `position` (rad), with `velocity` (rad/s), now.
  void put(double position, double velocity) {
    position += offset_;
    from_ = simulation_.now(), from_position_ = position;
    to_ = instant_from(from_);
    position_ = position + 1e-9 * double(to_ - from_) * velocity;
    if (velocity_) *velocity_ = velocity;
    simulation_.tell_of_change();
  }

  /// Runs until `time` (ns); returns the measured position, rad.
  double position_at(std::int64_t time) {
    const std::int64_t before = last_instant_before(time);
    if (before >= simulation_.now()) {
      simulation_.run_until(before);
      from_ = before, from_position_ = position_;
      to_ = instant_from(time);
    }
    simulation_.run_until(time);
    const double part = to_ > from_ ? double(time - from_) / double(to_ - from_) : 1;
    return from_position_ + part * (position_ - from_position_) - offset_;
  }

 private:
  std::uint64_t run_from(std::int64_t time) const { return time <= phase_ ? 0 : rate_.first_from(time - phase_); }
  /// Returns the instant of the motion at `time` or later.
  std::int64_t instant_from(std::int64_t time) const {
    return rate_.on_demand() ? time : phase_ + rate_.time_of(run_from(time));
  }
  /// Returns the last instant before `time`; negative: there is none.
  std::int64_t last_instant_before(std::int64_t time) const {
    const std::uint64_t next = rate_.on_demand() ? 0 : run_from(time);
    return next == 0 ? -1 : phase_ + rate_.time_of(next - 1);
  }

  Simulation& simulation_;
  double& position_;
  double* velocity_ = nullptr;
  double offset_ = 0;  ///< rad, of the servo's encoder: true position minus measured position
  Rate rate_;          ///< rate of the motion
  std::int64_t phase_ = 0;
  std::int64_t from_ = 0, to_ = 0;  ///< instants around the present time; `position_` belongs to the second
  double from_position_ = 0;
};

/// Simulates a part of the record without gaps, starting now.
void follow_segment(Simulation& simulation, const RecordedCommands& commands, SimulatedJoint& joint,
                    const MotorRecord& record, const RecordSegment& segment, Residuals& residuals) {
  const std::int64_t start = simulation.now();
  const double begin = record.samples[segment.first].time;
  joint.put(segment.initial_position, segment.initial_velocity);
  for (std::size_t i = segment.first; i < segment.first + segment.intervals.size() && !simulation.stopped(); ++i) {
    const RecordSample& next = record.samples[i + 1];
    commands.set(record.samples[i], record.p_gain);
    residuals.errors.push_back(joint.position_at(start + whole_ns(next.time - begin)) - next.position);
    residuals.times.push_back(next.time);
  }
}

RecordError error_of(const Residuals& residuals) {
  RecordError e;
  double squares = 0;
  for (const double error : residuals.errors) {
    e.mean += std::abs(error);
    squares += error * error;
    e.largest = std::max(e.largest, std::abs(error));
  }
  const double count = double(std::max<std::size_t>(residuals.errors.size(), 1));
  e.mean /= count;
  e.rms = std::sqrt(squares / count);
  return e;
}

/// Returns the notes on a comparison, in addition to its figures.
std::vector<std::string> notes_on(const MotorRecord& record, const PreparedRecord& prepared) {
  std::vector<std::string> notes = record.notes;
  std::string gaps;
  for (std::size_t i = 1; i < prepared.segments.size(); ++i) {
    const std::size_t first = prepared.segments[i].first;
    gaps += fmt::format("{}{:.4g} to {:.4g} s", i == 1 ? "" : ", ", record.samples[first - 1].time,
                        record.samples[first].time);
  }
  if (!gaps.empty())
    notes.push_back(fmt::format(
        "{}: nothing is recorded from {}; behind each gap the joint starts anew from the record", record.name, gaps));
  for (const RecordSegment& s : prepared.segments)
    if (s.initial_velocity != 0)
      notes.push_back(
          fmt::format("{}: at {:.4g} s the joint starts with {:.3g} rad/s, the slope of the recorded positions",
                      record.name, record.samples[s.first].time, s.initial_velocity));
  if (record.duty_gain > 0 || record.duty_limit > 0)
    notes.push_back(record.name +
                    ": its `duty_gain` and `duty_limit` are for identify; here those of the scenario hold");
  return notes;
}

void follow_record(Simulation& simulation, const std::string& joint, const MotorRecord& record,
                   RecordDeviation& result) {
  const RecordedCommands commands(simulation, joint);
  SimulatedJoint simulated(simulation, joint);
  constexpr double whole_intervals = 1e9;  // s: the simulation divides them itself
  const PreparedRecord prepared = prepare(record, whole_intervals);
  const auto start = std::chrono::steady_clock::now();
  for (const RecordSegment& s : prepared.segments)
    follow_segment(simulation, commands, simulated, record, s, result.residuals);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.error = error_of(result.residuals);
  result.cost = wall / std::max(1e-9 * double(simulation.now()), 1e-9);
  for (std::string& n : notes_on(record, prepared)) result.record_notes.push_back(std::move(n));
  const bool has_torque_off =
      std::any_of(record.samples.begin(), record.samples.end(), [](const RecordSample& s) { return !s.torque_enable; });
  if (has_torque_off && !commands.can_disable())
    result.record_notes.push_back(record.name + ": in it the torque is off for a while, which " + in_backquotes(joint) +
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
    const BuiltScenario built = build_variation(comparison, variation, registry, log);
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
    std::vector<std::string> notes;
    for (std::size_t v = 0; v < variations; ++v) {
      const RecordDeviation& d = deviations[i * variations + v];
      if (!d.failure.empty()) {
        text += fmt::format("  {:<{}}  did not run: {}\n", d.label, wide, d.failure);
        continue;
      }
      row(d.label, d.error, fmt::format("{:.2g}", d.cost));
      for (const std::string& n : d.record_notes)
        if (std::find(notes.begin(), notes.end(), n) == notes.end()) notes.push_back(n);
      sums[v].mean += d.error.mean, sums[v].rms += d.error.rms * d.error.rms;
      sums[v].largest = std::max(sums[v].largest, d.error.largest);
      ++counts[v];
    }
    for (const std::string& n : notes) text += "  " + n + "\n";
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
