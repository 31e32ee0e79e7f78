// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "binary.hpp"
#include "message_log.hpp"
#include "model_description.hpp"
#include "muro/algorithm.hpp"
#include "muro/ext/call_note.hpp"
#include "plugins/controller/common/copy_guard/copy_guard.hpp"

namespace muro::fmu {

/// Result of a communication step without an error. Only the reasons given here can make it incomplete.
struct StepOutcome {
  bool is_discarded = false;
  bool wants_end = false;    ///< terminateSimulation, fmi2Terminated
  bool needs_event = false;  ///< eventHandlingNeeded
  bool returned_early = false;
  bool knows_last_time = false;  ///< for a step that was discarded or returned early
  double last_time = 0;          ///< time that it reached, s
};

/// A failure of an instance's process that the clock of the machine, or another process, has influenced: the run cannot
/// be repeated.
class FailureFromOutside : public Error {
 public:
  using Error::Error;
};

/// One instance of an FMU. Functions throw Error with the message of the FMU when it returns an error. A value of
/// `Type::boolean` has one byte in FMI 3 and four in FMI 2; an enumeration has eight and four.
class Component {
 public:
  struct Setup {
    const ModelDescription* description = nullptr;
    const Binary* binary = nullptr;   ///< for an instance in this process
    std::filesystem::path library;    ///< for an instance in a separate process
    double timeout = 0;               ///< limit for a call in a separate process, s of wall-clock time
    std::filesystem::path resources;  ///< empty: there are none
    std::string name;
    CallNotes* notes = nullptr;
    MessageLog* log = nullptr;
  };

  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  virtual void instantiate() = 0;
  /// Returns to the state after instantiate(). Frees the instance and makes a new one when the FMU cannot be reset.
  virtual void reset() = 0;
  /// Structural parameters, which only FMI 3 has, are set between these two, before the initialization.
  virtual void enter_configuration() {}
  virtual void exit_configuration() {}
  virtual void enter_initialization(double start) = 0;
  virtual void exit_initialization() = 0;

  /// `values`: the values of all variables, one after the other: `count` numbers.
  virtual void set(Type type, std::span<const std::uint32_t> references, const void* values, std::size_t count) = 0;
  virtual void get(Type type, std::span<const std::uint32_t> references, void* values, std::size_t count) = 0;
  virtual void set_text(std::uint32_t reference, const std::string& text) = 0;
  virtual void set_bytes(std::uint32_t reference, std::span<const std::uint8_t> bytes) = 0;
  /// Returns bytes that belong to the FMU and are valid until the next call.
  virtual std::span<const std::uint8_t> get_bytes(std::uint32_t reference) = 0;

  virtual StepOutcome do_step(double time, double size) = 0;

  /// Keeps the state within the FMU. Replaces a state that was kept before.
  virtual void keep_state() = 0;
  /// Returns to the kept state.
  virtual void return_to_state() = 0;
  /// Returns the size of the kept state, bytes; write_state() writes it.
  virtual std::size_t state_size() = 0;
  virtual void write_state(std::span<std::uint8_t> bytes) = 0;
  /// Takes bytes of write_state() as the state and as the kept state.
  virtual void read_state(std::span<const std::uint8_t> bytes) = 0;

 protected:
  explicit Component(const Setup& setup) : setup_(setup) {}

  /// Calls a function of the FMU. Notes its name for messages about a call that does not return.
  template <class Function, class... Arguments>
  Status status_of(const char* name, Function* function, Arguments... arguments) {
    CallNote* const note = setup_.notes ? &setup_.notes->of_this_thread() : nullptr;
    if (note) note->set_library(setup_.binary->path().c_str(), name);
    const CopyGuard guard;
    const auto status = Status(function(arguments...));
    CopyGuard::end_copy(name);
    if (note) note->set_library(nullptr, nullptr);
    return status;
  }
  /// Calls a function in the same way. Throws when the status is neither ok nor a warning.
  template <class Function, class... Arguments>
  void call(const char* name, Function* function, Arguments... arguments) {
    const Status status = status_of(name, function, arguments...);
    if (status != Status::ok && status != Status::warning) fail(name, status);
  }
  [[noreturn]] void fail(const char* name, Status status);
  /// Keeps memory of an FMU after a fatal error, when no function that would free it may be called.
  static void abandon(void* something);
  /// Throws Error unless this function of the FMU returns a text that begins with `expected`.
  void check_version(const char* function, std::string_view expected);

  Setup setup_;
  bool is_running_ = false;  ///< initialized, and no function has failed
  bool is_corrupt_ = false;  ///< after a fatal error no function may be called
};

/// Returns the size of a number of a type in functions of FMI, bytes.
std::size_t bytes_of(Type type, int version);

std::unique_ptr<Component> make_component(const Component::Setup& setup);
/// Makes an instance in a separate process; a crash ends only that process.
std::unique_ptr<Component> make_remote_component(const Component::Setup& setup);
/// These two are used by make_component.
std::unique_ptr<Component> make_component_2(const Component::Setup& setup);
std::unique_ptr<Component> make_component_3(const Component::Setup& setup);

}  // namespace muro::fmu
