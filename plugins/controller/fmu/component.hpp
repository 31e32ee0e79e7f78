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

/// What came of one communication step that is neither an error nor incomplete for another reason.
struct StepOutcome {
  bool is_discarded = false;
  bool wants_end = false;    ///< terminateSimulation, fmi2Terminated
  bool needs_event = false;  ///< eventHandlingNeeded
  bool returned_early = false;
  bool knows_last_time = false;  ///< of a step that was discarded or returned early
  double last_time = 0;          ///< s, how far it got
};

/// A failure of the process of an instance in which the clock of the machine, or another process, has a part: the run
/// cannot be repeated.
class FailureFromOutside : public Error {
 public:
  using Error::Error;
};

/// One instance of an FMU. Functions throw Error when the FMU returns an error, with the words of the FMU. An FMI 3
/// instance of `Type::boolean` has one byte for a value, all of FMI 2 have four; enumerations eight and four.
class Component {
 public:
  struct Setup {
    const ModelDescription* description = nullptr;
    const Binary* binary = nullptr;   ///< of an instance in this process
    std::filesystem::path library;    ///< of one in a process of its own
    double timeout = 0;               ///< s of wall-clock time for a call of one in a process of its own
    std::filesystem::path resources;  ///< empty: there are none
    std::string name;
    CallNotes* notes = nullptr;
    MessageLog* log = nullptr;
  };

  virtual ~Component() = default;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  virtual void instantiate() = 0;
  /// As after instantiate(): frees it and makes it anew where the FMU cannot be reset.
  virtual void reset() = 0;
  /// Structural parameters, which FMI 3 alone has, are set between these two, before the initialization.
  virtual void enter_configuration() {}
  virtual void exit_configuration() {}
  virtual void enter_initialization(double start) = 0;
  virtual void exit_initialization() = 0;

  /// `values` are those of all variables one behind the other: `count` numbers.
  virtual void set(Type type, std::span<const std::uint32_t> references, const void* values, std::size_t count) = 0;
  virtual void get(Type type, std::span<const std::uint32_t> references, void* values, std::size_t count) = 0;
  virtual void set_text(std::uint32_t reference, const std::string& text) = 0;
  virtual void set_bytes(std::uint32_t reference, std::span<const std::uint8_t> bytes) = 0;
  /// They are the FMU's until the next call.
  virtual std::span<const std::uint8_t> get_bytes(std::uint32_t reference) = 0;

  virtual StepOutcome do_step(double time, double size) = 0;

  /// Keeps the state within the FMU, in place of the one that was kept before.
  virtual void keep_state() = 0;
  /// Back to the state that was kept.
  virtual void return_to_state() = 0;
  /// The state that was kept as bytes.
  virtual std::size_t state_size() = 0;
  virtual void write_state(std::span<std::uint8_t> bytes) = 0;
  /// Takes bytes of write_state() as its state, which is then the one that is kept.
  virtual void read_state(std::span<const std::uint8_t> bytes) = 0;

 protected:
  explicit Component(const Setup& setup) : setup_(setup) {}

  /// Calls a function of the FMU under its name, for messages about a call that does not return.
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
  /// The same; what is neither ok nor a warning is thrown.
  template <class Function, class... Arguments>
  void call(const char* name, Function* function, Arguments... arguments) {
    const Status status = status_of(name, function, arguments...);
    if (status != Status::ok && status != Status::warning) fail(name, status);
  }
  [[noreturn]] void fail(const char* name, Status status);
  /// Keeps what belongs to an FMU after a fatal error, when no function may be called that would free it.
  static void abandon(void* something);
  /// Throws Error unless this function of the FMU returns a text that begins with `expected`.
  void check_version(const char* function, std::string_view expected);

  Setup setup_;
  bool is_running_ = false;  ///< initialized, and no function has failed
  bool is_corrupt_ = false;  ///< after a fatal error no function may be called
};

/// Bytes of a number of a type as functions of FMI take it.
std::size_t bytes_of(Type type, int version);

std::unique_ptr<Component> make_component(const Component::Setup& setup);
/// In a process of its own, which crashes alone.
std::unique_ptr<Component> make_remote_component(const Component::Setup& setup);
/// For make_component.
std::unique_ptr<Component> make_component_2(const Component::Setup& setup);
std::unique_ptr<Component> make_component_3(const Component::Setup& setup);

}  // namespace muro::fmu
