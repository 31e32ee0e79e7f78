// SPDX-License-Identifier: MIT
// One instance of control code, in this process or in one of its own.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "control_table.hpp"

namespace muro::control {

/// What an instance is told when it is created.
struct InstanceSetup {
  std::string robot;
  std::uint32_t index = 0, count = 1;
  std::vector<std::string> arguments;  ///< "name=value"
  std::vector<double> tunables;        ///< by place in the table
  std::vector<double> task_rates;      ///< Hz, the same
};

/// Where the data of an instance lies, which it reads and writes in its calls.
struct InstanceMemory {
  std::vector<void*> inputs, outputs;                    ///< by place in the table: double, int64_t or char
  std::vector<std::uint32_t> input_sizes, output_sizes;  ///< elements; those of lists change
  void* state = nullptr;                                 ///< the block, or what is saved of the instance
  std::uint64_t* saved_size = nullptr;                   ///< bytes, of an instance that is saved
};

enum class Function : std::uint32_t {
  create,  ///< begins anew: in a cleared block, or as a new instance
  resume,  ///< goes on from the state: for instances with memory of their own
  step,
  destroy,  ///< of an instance with memory of its own; without effect on others
};

/// One call. The functions of the library behind it: `create` or `instantiate`; `instantiate` and `load`; the tasks
/// that are due, `step`, `save`; `destroy`.
struct Call {
  Function function = Function::step;
  double time = 0;          ///< s
  double period = 0;        ///< s between steps
  std::uint64_t seed = 0;   ///< of the instance
  std::uint64_t index = 0;  ///< of the step
  bool is_patient = false;  ///< there is no time-out: a recording says whether there was one
  /// Null, or where it is written which function of the library runs: its name, or a copy of it.
  std::atomic<const char*>* running = nullptr;
  std::span<char> running_text{};
};

/// How a call ended.
enum class Ending : std::uint32_t {
  fine,
  refused,        ///< the library says no; the reason is its own, and may be empty
  threw,          ///< an exception left a function
  out_of_memory,  ///< of a process of its own: its bound
  crashed,        ///< the process of its own ended by a signal
  exited,         ///< the control code has ended it
  timed_out,      ///< the call did not return in time
  no_process,     ///< it cannot be started
};

struct Outcome {
  Ending ending = Ending::fine;
  const char* function = "";  ///< of the library, in which it ended
  std::string reason{};
  std::string stack{};           ///< of calls, lines; empty where there is none
  bool is_from_outside = false;  ///< by a signal that another process, or the system, may have sent

  bool is_fine() const { return ending == Ending::fine; }
};

/// A line that control code logs.
struct LogSink {
  void* context = nullptr;
  void (*write)(void* context, std::uint32_t level, const char* text) = nullptr;
};

class ControlInstance {
 public:
  ControlInstance() = default;
  virtual ~ControlInstance() = default;
  ControlInstance(const ControlInstance&) = delete;
  ControlInstance& operator=(const ControlInstance&) = delete;

  /// Where the control code finds and leaves its data.
  virtual InstanceMemory& memory() = 0;
  /// Does not throw what the control code throws.
  virtual Outcome call(const Call& call) = 0;
  /// Whether it can be called; a process of its own may be gone.
  virtual bool is_alive() const = 0;
};

/// Every how many steps of `period` s a task of `rate` Hz runs.
inline double steps_between(double rate, double period) { return std::max(1.0, std::nearbyint(1 / (rate * period))); }

/// "step", as it stands in messages: of several the first.
const char* name_of(Function function, bool has_instances);

}  // namespace muro::control
