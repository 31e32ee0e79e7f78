// SPDX-License-Identifier: MIT
// An instance of an FMU of FMI 2.0.
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "component.hpp"
#include "fmi2_api.h"
#include "muro/algorithm.hpp"

namespace muro::fmu {

namespace {

void log_of_fmi2(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String, fmi2String format,
                 ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format ? format : "", arguments);
  va_end(arguments);
  if (environment) static_cast<MessageLog*>(environment)->say(Status(status), text);
}

void* allocate_for_fmi2(std::size_t count, std::size_t size) { return std::calloc(count, size); }
void free_for_fmi2(void* memory) { std::free(memory); }

/// Returns the URI of a path (RFC 3986): characters other than letters, digits and marks become %HH.
std::string uri_of(const std::string& path) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool stands = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                        c == '-' || c == '.' || c == '_' || c == '~';
    if (stands)
      uri += c;
    else
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return uri;
}

class Component2 final : public Component {
 public:
  explicit Component2(const Setup& setup) : Component(setup) {
    const Binary& b = *setup.binary;
    check_version("fmi2GetVersion", "2.");
    check_version("fmi2GetTypesPlatform", "default");
    b.get(instantiate_, "fmi2Instantiate");
    b.get(free_, "fmi2FreeInstance");
    b.get(setup_experiment_, "fmi2SetupExperiment");
    b.get(enter_, "fmi2EnterInitializationMode");
    b.get(exit_, "fmi2ExitInitializationMode");
    b.get(terminate_, "fmi2Terminate");
    b.get(reset_, "fmi2Reset");
    b.get(get_real_, "fmi2GetReal");
    b.get(get_integer_, "fmi2GetInteger");
    b.get(get_boolean_, "fmi2GetBoolean");
    b.get(set_real_, "fmi2SetReal");
    b.get(set_integer_, "fmi2SetInteger");
    b.get(set_boolean_, "fmi2SetBoolean");
    b.get(set_string_, "fmi2SetString");
    b.get(do_step_, "fmi2DoStep");
    b.get(get_status_, "fmi2GetStatus");
    b.get(get_real_status_, "fmi2GetRealStatus");
    b.get(get_boolean_status_, "fmi2GetBooleanStatus");
    if (setup.description->can_keep_state) {
      b.get(get_state_, "fmi2GetFMUstate");
      b.get(set_state_, "fmi2SetFMUstate");
      b.get(free_state_, "fmi2FreeFMUstate");
    }
    if (setup.description->can_serialize_state) {
      b.get(state_size_, "fmi2SerializedFMUstateSize");
      b.get(write_state_, "fmi2SerializeFMUstate");
      b.get(read_state_, "fmi2DeSerializeFMUstate");
    }
    callbacks_ = {log_of_fmi2, allocate_for_fmi2, free_for_fmi2, nullptr, setup.log};
    if (!setup.resources.empty()) uri_ = uri_of(setup.resources.string());
  }
  ~Component2() override { free(); }

  void instantiate() override {
    status_of(
        "fmi2Instantiate",
        +[](Component2* self) {
          self->instance_ =
              self->instantiate_(self->setup_.name.c_str(), fmi2CoSimulation, self->setup_.description->token.c_str(),
                                 self->uri_.c_str(), &self->callbacks_, fmi2False, fmi2True);
          return fmi2OK;
        },
        this);
    if (!instance_) {
      const std::string said = setup_.log->take_reason();
      throw Error("`fmi2Instantiate` makes no instance" +
                  (said.empty() ? ", and the FMU gives no reason" : ": " + said));
    }
  }

  void reset() override {
    is_running_ = false;
    if (is_corrupt_) throw Error("it cannot be used again after a fatal error; start the program anew");
    if (instance_ && status_of("fmi2Reset", reset_, instance_) == Status::ok) return;
    free();
    instantiate();
  }

  void enter_initialization(double start) override {
    const double tolerance = setup_.description->tolerance;
    call("fmi2SetupExperiment", setup_experiment_, instance_, fmi2Boolean(tolerance > 0), tolerance, start,
         fmi2Boolean(fmi2False), 0.0);
    call("fmi2EnterInitializationMode", enter_, instance_);
  }
  void exit_initialization() override {
    call("fmi2ExitInitializationMode", exit_, instance_);
    is_running_ = true;
  }

  void set(Type type, std::span<const std::uint32_t> r, const void* values, std::size_t) override {
    if (type == Type::float64)
      call("fmi2SetReal", set_real_, instance_, r.data(), r.size(), static_cast<const fmi2Real*>(values));
    else if (type == Type::boolean)
      call("fmi2SetBoolean", set_boolean_, instance_, r.data(), r.size(), static_cast<const fmi2Boolean*>(values));
    else
      call("fmi2SetInteger", set_integer_, instance_, r.data(), r.size(), static_cast<const fmi2Integer*>(values));
  }
  void get(Type type, std::span<const std::uint32_t> r, void* values, std::size_t) override {
    if (type == Type::float64)
      call("fmi2GetReal", get_real_, instance_, r.data(), r.size(), static_cast<fmi2Real*>(values));
    else if (type == Type::boolean)
      call("fmi2GetBoolean", get_boolean_, instance_, r.data(), r.size(), static_cast<fmi2Boolean*>(values));
    else
      call("fmi2GetInteger", get_integer_, instance_, r.data(), r.size(), static_cast<fmi2Integer*>(values));
  }
  void set_text(std::uint32_t reference, const std::string& text) override {
    const fmi2String value = text.c_str();
    call("fmi2SetString", set_string_, instance_, static_cast<const fmi2ValueReference*>(&reference), std::size_t(1),
         &value);
  }
  void set_bytes(std::uint32_t, std::span<const std::uint8_t>) override {}
  std::span<const std::uint8_t> get_bytes(std::uint32_t) override { return {}; }

  StepOutcome do_step(double time, double size) override {
    const auto no_state_before = fmi2Boolean(!setup_.description->can_keep_state);
    Status status = status_of("fmi2DoStep", do_step_, instance_, time, size, no_state_before);
    while (status == Status::pending) {
      fmi2Status now = fmi2Pending;
      call("fmi2GetStatus", get_status_, instance_, fmi2DoStepStatus, &now);
      status = Status(now);
      if (status == Status::pending) usleep(50);
    }
    StepOutcome outcome;
    if (status == Status::ok || status == Status::warning) return outcome;
    if (status != Status::discard) fail("fmi2DoStep", status);
    outcome.is_discarded = true;
    fmi2Boolean terminated = fmi2False;
    outcome.wants_end =
        status_of("fmi2GetBooleanStatus", get_boolean_status_, instance_, fmi2Terminated, &terminated) == Status::ok &&
        terminated != fmi2False;
    outcome.knows_last_time = status_of("fmi2GetRealStatus", get_real_status_, instance_, fmi2LastSuccessfulTime,
                                        &outcome.last_time) == Status::ok;
    return outcome;
  }

  void keep_state() override { call("fmi2GetFMUstate", get_state_, instance_, &state_); }
  void return_to_state() override { call("fmi2SetFMUstate", set_state_, instance_, state_); }
  std::size_t state_size() override {
    std::size_t size = 0;
    call("fmi2SerializedFMUstateSize", state_size_, instance_, state_, &size);
    return size;
  }
  void write_state(std::span<std::uint8_t> bytes) override {
    call("fmi2SerializeFMUstate", write_state_, instance_, state_, reinterpret_cast<fmi2Byte*>(bytes.data()),
         bytes.size());
  }
  void read_state(std::span<const std::uint8_t> bytes) override {
    if (state_) call("fmi2FreeFMUstate", free_state_, instance_, &state_);
    state_ = nullptr;
    call("fmi2DeSerializeFMUstate", read_state_, instance_, reinterpret_cast<const fmi2Byte*>(bytes.data()),
         bytes.size(), &state_);
    return_to_state();
    is_running_ = true;
  }

 private:
  void free() {
    if (!instance_) return;
    if (is_corrupt_) {
      abandon(instance_), abandon(state_);
      instance_ = nullptr;
      return;
    }
    if (state_) status_of("fmi2FreeFMUstate", free_state_, instance_, &state_);
    if (is_running_) status_of("fmi2Terminate", terminate_, instance_);
    is_running_ = false;
    status_of(
        "fmi2FreeInstance", +[](fmi2FreeInstanceTYPE* f, fmi2Component c) { return f(c), fmi2OK; }, free_, instance_);
    instance_ = nullptr;
    state_ = nullptr;
  }

  fmi2CallbackFunctions callbacks_{};
  std::string uri_;
  fmi2Component instance_ = nullptr;
  fmi2FMUstate state_ = nullptr;

  fmi2InstantiateTYPE* instantiate_ = nullptr;
  fmi2FreeInstanceTYPE* free_ = nullptr;
  fmi2SetupExperimentTYPE* setup_experiment_ = nullptr;
  fmi2EnterInitializationModeTYPE* enter_ = nullptr;
  fmi2ExitInitializationModeTYPE* exit_ = nullptr;
  fmi2TerminateTYPE* terminate_ = nullptr;
  fmi2ResetTYPE* reset_ = nullptr;
  fmi2GetRealTYPE* get_real_ = nullptr;
  fmi2GetIntegerTYPE* get_integer_ = nullptr;
  fmi2GetBooleanTYPE* get_boolean_ = nullptr;
  fmi2SetRealTYPE* set_real_ = nullptr;
  fmi2SetIntegerTYPE* set_integer_ = nullptr;
  fmi2SetBooleanTYPE* set_boolean_ = nullptr;
  fmi2SetStringTYPE* set_string_ = nullptr;
  fmi2DoStepTYPE* do_step_ = nullptr;
  fmi2GetStatusTYPE* get_status_ = nullptr;
  fmi2GetRealStatusTYPE* get_real_status_ = nullptr;
  fmi2GetBooleanStatusTYPE* get_boolean_status_ = nullptr;
  fmi2GetFMUstateTYPE* get_state_ = nullptr;
  fmi2SetFMUstateTYPE* set_state_ = nullptr;
  fmi2FreeFMUstateTYPE* free_state_ = nullptr;
  fmi2SerializedFMUstateSizeTYPE* state_size_ = nullptr;
  fmi2SerializeFMUstateTYPE* write_state_ = nullptr;
  fmi2DeSerializeFMUstateTYPE* read_state_ = nullptr;
};

}  // namespace

std::unique_ptr<Component> make_component_2(const Component::Setup& setup) {
  return std::make_unique<Component2>(setup);
}

}  // namespace muro::fmu
