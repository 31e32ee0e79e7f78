// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "connections.hpp"
#include "control_instance.hpp"
#include "control_library.hpp"
#include "control_process.hpp"
#include "failure_log.hpp"
#include "muro/algorithm.hpp"
#include "muro/ext/call_note.hpp"
#include "muro/ext/report_entries.hpp"
#include "port.hpp"

namespace muro::control {

/// Effect on a run when the control code of a robot fails.
enum class OnFailure : std::uint8_t {
  stop,     ///< the run ends
  hold,     ///< the robot stays at rest
  restart,  ///< the robot rests for a step, and its control code starts anew
};

/// Data that all robots of one controller share.
struct ControlSettings {
  std::string path;  ///< path of the library
  ControlTable table;
  std::optional<muro_controller_table> functions;  ///< none: the instances run in separate processes
  std::vector<std::string> arguments;
  std::vector<double> tunables, task_rates;
  OnFailure on_failure = OnFailure::stop;
  std::uint32_t restarts = 0;  ///< most restarts of a robot's control code
  ProcessLimits limits;
  Host* host = nullptr;
  CallNotes* notes = nullptr;
};

/// The state of one robot: this block, then the library's own state. Its size is a multiple of 64 bytes. So the states
/// of all robots, one after the other, have the alignment that the C header promises.
struct alignas(64) StateBlock {
  std::uint64_t created;     ///< 0 until the library's `create` has run
  std::uint64_t saved_size;  ///< bytes, for an instance with its own memory
  std::uint32_t is_held;     ///< the control code has failed, and the robot stays at rest
  std::uint32_t restarts;    ///< number of restarts of the control code

  void* state() { return this + 1; }
  static std::uint32_t size_for(std::size_t state_size) {
    return std::uint32_t(sizeof(StateBlock) + (state_size + 63) / 64 * 64);
  }
};

/// One robot and its instance of the control code.
class ControlledRobot {
 public:
  /// `item`: index among the items of the controller. [setup]
  ControlledRobot(const ControlSettings& settings, std::string name, std::uint32_t item, std::uint32_t count,
                  std::uint64_t random_key, StateBlock* block);

  const std::string& name() const { return name_; }
  /// Sets the log that records and replays failures that do not depend on the scenario alone. [setup]
  void use_failure_log(std::unique_ptr<FailureLog> log) { failures_ = std::move(log); }
  /// Takes over a process that has already loaded the library. [setup]
  void use_process(std::unique_ptr<ControlProcess> process) { process_ = std::move(process); }
  /// Finds and binds the properties of all ports. Returns the optional inputs that are missing. [setup]
  std::vector<std::string> connect(Connector& connector, const RobotObjects& objects, const Connections& inputs,
                                   const Connections& outputs);
  /// Returns texts about inputs that work, but probably not as intended. [after connect]
  const std::vector<std::string>& doubts() const { return doubts_; }
  /// Returns texts about outputs that have no effect. [after connect]
  const std::vector<std::string>& notes() const { return notes_; }
  /// Makes a property for each output that belongs to the library itself. [setup]
  void create_own_properties(Connector& connector, ObjectId object);

  void start();
  void step(const Step& step);
  /// Called after a snapshot has replaced the properties.
  void restored();
  /// Reports the number of failures of the control code, if there are any. [finish]
  void report(ReportEntries& report) const;

 private:
  using Ports = std::vector<Port>;

  Port connect_port(Connector& c, const PropertyFinder& finder, const muro_port& port, const Connections& connections,
                    bool input);
  void doubt_if_too_slow(const Connector& c, const FoundProperty& found, const muro_port& port);
  void measure();
  void check_size(const Port& port, const muro_port& wanted, bool input) const;
  InstanceMemory own_memory();
  void make_instance();
  /// `rate`: of the controller, Hz.
  void check_tasks(double rate) const;
  void read_ports(InstanceMemory& memory) const;
  bool write_ports(const InstanceMemory& memory, std::string& why_not) const;
  bool call(Call& call, const Step& step);
  Outcome outcome_of(Call& call, const Step& step);
  void fail(std::string what, const std::string& stack);
  std::string about(const muro_port& port, bool input) const;
  std::string about() const;
  void note(const char* function) const;
  static void write_log(void* context, std::uint32_t level, const char* text);

  const ControlSettings& settings_;
  std::string name_;
  std::uint32_t item_, count_;
  std::uint64_t random_key_;
  StateBlock* block_;
  Ports inputs_, outputs_;
  std::vector<std::string> doubts_, notes_;
  std::vector<std::uint64_t> copies_;  ///< data of all ports that are not read directly; written again in every step
  std::unique_ptr<ControlProcess> process_;
  std::unique_ptr<ControlInstance> instance_;
  std::unique_ptr<FailureLog> failures_;  ///< null: not used in the simulator's process
  std::uint64_t failure_count_ = 0;       ///< since the start, for the report
  bool is_stale_ = false;                 ///< the instance does not match the state
};

}  // namespace muro::control
