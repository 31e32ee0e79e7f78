// SPDX-License-Identifier: MIT
// One instance of control code, in this process or in a separate one.
#pragma once

#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "control_table.hpp"

namespace muro::control {

/// Data that an instance gets when it is created.
struct InstanceSetup {
  std::string robot;
  std::uint32_t index = 0, count = 1;
  std::vector<std::string> arguments;  ///< each as "name=value"
  std::vector<double> tunables;        ///< by index in the table
  std::vector<double> task_rates;      ///< Hz, by index in the table
};

/// Addresses of an instance's data, which it reads and writes in its calls.
struct InstanceMemory {
  std::vector<void*> inputs, outputs;                    ///< by index in the table: double, int64_t or char
  std::vector<std::uint32_t> input_sizes, output_sizes;  ///< numbers of elements; they change for lists
  void* state = nullptr;                                 ///< state block, or saved data of the instance
  std::uint64_t* saved_size = nullptr;                   ///< bytes, for an instance that is saved
};

enum class Function : std::uint32_t {
  create,  ///< starts with a cleared block, or as a new instance
  resume,  ///< continues from the state: for instances with their own memory
  step,
  destroy,  ///< ends an instance with its own memory; no effect on others
};

/// One call. It runs these functions of the library: `create` or `instantiate`; `instantiate` and `load`; the tasks
/// that are due, `step`, `save`; `destroy`.
struct Call {
  Function function = Function::step;
  double time = 0;          ///< s
  double period = 0;        ///< s between steps
  std::uint64_t seed = 0;   ///< random seed of the instance
  std::uint64_t index = 0;  ///< index of the step
  bool is_patient = false;  ///< no time-out: a recording contains the time-outs
  /// Places for the name of the running library function: a pointer to it, and a copy. Null or empty: not needed.
  std::atomic<const char*>* running = nullptr;
  std::span<char> running_text{};
};

/// The result of a call.
enum class Ending : std::uint32_t {
  fine,
  refused,        ///< the library refused; the reason is its own, and may be empty
  threw,          ///< an exception left a function
  out_of_memory,  ///< a separate process has reached its limit
  crashed,        ///< the separate process was ended by a signal
  exited,         ///< the control code has ended the process
  timed_out,      ///< the call did not return in time
  no_process,     ///< the process cannot be started
};

struct Outcome {
  Ending ending = Ending::fine;
  const char* function = "";  ///< function of the library in which the call ended
  std::string reason{};
  std::string stack{};           ///< calls on the stack, as lines; empty when unknown
  bool is_from_outside = false;  ///< by a signal that another process, or the system, may have sent

  bool is_fine() const { return ending == Ending::fine; }
};

/// Receives a line that control code logs.
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

  /// Addresses through which the control code gets and returns its data.
  virtual InstanceMemory& memory() = 0;
  /// Runs a call. Does not throw exceptions of the control code.
  virtual Outcome call(const Call& call) = 0;
  /// Whether it can be called; a separate process may have ended.
  virtual bool is_alive() const = 0;
};

/// Returns the number of `period` s steps from one run of a task at `rate` Hz to the next.
inline double steps_between(double rate, double period) { return std::max(1.0, std::nearbyint(1 / (rate * period))); }

/// Returns the name of a function for messages, such as "step"; the first name when the call runs several functions.
const char* name_of(Function function, bool has_instances);

}  // namespace muro::control
