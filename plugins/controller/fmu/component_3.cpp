// SPDX-License-Identifier: MIT
// An instance of an FMU of FMI 3.0.
#include "component.hpp"
#include "fmi3_api.h"
#include "muro/algorithm.hpp"

namespace muro::fmu {

namespace {

void log_of_fmi3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String, fmi3String text) {
  if (environment) static_cast<MessageLog*>(environment)->say(Status(status), text ? text : "");
}

/// The functions for variables of one type, and their names.
struct Access {
  const char* get_name = nullptr;
  const char* set_name = nullptr;
  fmi3Status (*get)(void* function, fmi3Instance, const fmi3ValueReference*, std::size_t, void*, std::size_t) = nullptr;
  fmi3Status (*set)(void* function, fmi3Instance, const fmi3ValueReference*, std::size_t, const void*,
                    std::size_t) = nullptr;
};
template <class T>
constexpr Access access(const char* get_name, const char* set_name) {
  return {
      get_name, set_name,
      [](void* function, fmi3Instance c, const fmi3ValueReference* r, std::size_t n, void* values, std::size_t count) {
        using Get = fmi3Status(fmi3Instance, const fmi3ValueReference[], std::size_t, T[], std::size_t);
        return reinterpret_cast<Get*>(function)(c, r, n, static_cast<T*>(values), count);
      },
      [](void* function, fmi3Instance c, const fmi3ValueReference* r, std::size_t n, const void* values,
         std::size_t count) {
        using Set = fmi3Status(fmi3Instance, const fmi3ValueReference[], std::size_t, const T[], std::size_t);
        return reinterpret_cast<Set*>(function)(c, r, n, static_cast<const T*>(values), count);
      }};
}
/// In the order of Type, up to `enumeration`, which is an Int64.
constexpr Access accesses[] = {
    access<double>("fmi3GetFloat64", "fmi3SetFloat64"),      access<float>("fmi3GetFloat32", "fmi3SetFloat32"),
    access<std::int64_t>("fmi3GetInt64", "fmi3SetInt64"),    access<std::uint64_t>("fmi3GetUInt64", "fmi3SetUInt64"),
    access<std::int32_t>("fmi3GetInt32", "fmi3SetInt32"),    access<std::uint32_t>("fmi3GetUInt32", "fmi3SetUInt32"),
    access<std::int16_t>("fmi3GetInt16", "fmi3SetInt16"),    access<std::uint16_t>("fmi3GetUInt16", "fmi3SetUInt16"),
    access<std::int8_t>("fmi3GetInt8", "fmi3SetInt8"),       access<std::uint8_t>("fmi3GetUInt8", "fmi3SetUInt8"),
    access<fmi3Boolean>("fmi3GetBoolean", "fmi3SetBoolean"), access<std::int64_t>("fmi3GetInt64", "fmi3SetInt64")};
static_assert(sizeof(fmi3Boolean) == 1);

class Component3 final : public Component {
 public:
  explicit Component3(const Setup& setup) : Component(setup) {
    const Binary& b = *setup.binary;
    check_version("fmi3GetVersion", "3.");
    b.get(instantiate_, "fmi3InstantiateCoSimulation");
    b.get(free_, "fmi3FreeInstance");
    b.get(enter_, "fmi3EnterInitializationMode");
    b.get(exit_, "fmi3ExitInitializationMode");
    b.get(terminate_, "fmi3Terminate");
    b.get(reset_, "fmi3Reset");
    b.get(set_string_, "fmi3SetString");
    b.get(get_binary_, "fmi3GetBinary");
    b.get(set_binary_, "fmi3SetBinary");
    b.get(do_step_, "fmi3DoStep");
    for (std::size_t i = 0; i < std::size(accesses); ++i) {
      b.get(getters_[i], accesses[i].get_name);
      b.get(setters_[i], accesses[i].set_name);
    }
    if (setup.description->can_keep_state) {
      b.get(get_state_, "fmi3GetFMUState");
      b.get(set_state_, "fmi3SetFMUState");
      b.get(free_state_, "fmi3FreeFMUState");
    }
    if (setup.description->can_serialize_state) {
      b.get(state_size_, "fmi3SerializedFMUStateSize");
      b.get(write_state_, "fmi3SerializeFMUState");
      b.get(read_state_, "fmi3DeserializeFMUState");
    }
    if (!setup.resources.empty()) resources_ = setup.resources.string() + "/";
  }
  ~Component3() override { free(); }

  void instantiate() override {
    status_of(
        "fmi3InstantiateCoSimulation",
        +[](Component3* self) {
          const ModelDescription& d = *self->setup_.description;
          self->instance_ = self->instantiate_(self->setup_.name.c_str(), d.token.c_str(),
                                               self->resources_.empty() ? nullptr : self->resources_.c_str(), false,
                                               true, false, d.might_return_early && d.variable_step_size, nullptr, 0,
                                               self->setup_.log, log_of_fmi3, nullptr);
          return fmi3OK;
        },
        this);
    if (!instance_) {
      const std::string said = setup_.log->take_reason();
      throw Error("`fmi3InstantiateCoSimulation` makes no instance" +
                  (said.empty() ? ", and the FMU gives no reason" : ": " + said));
    }
  }

  void reset() override {
    is_running_ = false;
    if (is_corrupt_) throw Error("it cannot be used again after a fatal error; start the program anew");
    if (instance_ && status_of("fmi3Reset", reset_, instance_) == Status::ok) return;
    free();
    instantiate();
  }

  /// Loads the two functions here, because only FMUs with structural parameters to set need them.
  void enter_configuration() override {
    setup_.binary->get(enter_configuration_, "fmi3EnterConfigurationMode");
    setup_.binary->get(exit_configuration_, "fmi3ExitConfigurationMode");
    call("fmi3EnterConfigurationMode", enter_configuration_, instance_);
  }
  void exit_configuration() override { call("fmi3ExitConfigurationMode", exit_configuration_, instance_); }
  void enter_initialization(double start) override {
    const double tolerance = setup_.description->tolerance;
    call("fmi3EnterInitializationMode", enter_, instance_, tolerance > 0, tolerance, start, false, 0.0);
  }
  void exit_initialization() override {
    call("fmi3ExitInitializationMode", exit_, instance_);
    is_running_ = true;
  }

  void set(Type type, std::span<const std::uint32_t> r, const void* values, std::size_t count) override {
    const Access& a = accesses[std::size_t(type)];
    call(a.set_name, a.set, function_of(setters_, type), instance_, r.data(), r.size(), values, count);
  }
  void get(Type type, std::span<const std::uint32_t> r, void* values, std::size_t count) override {
    const Access& a = accesses[std::size_t(type)];
    call(a.get_name, a.get, function_of(getters_, type), instance_, r.data(), r.size(), values, count);
  }
  void set_text(std::uint32_t reference, const std::string& text) override {
    const fmi3String value = text.c_str();
    call("fmi3SetString", set_string_, instance_, static_cast<const fmi3ValueReference*>(&reference), std::size_t(1),
         &value, std::size_t(1));
  }
  void set_bytes(std::uint32_t reference, std::span<const std::uint8_t> bytes) override {
    const fmi3Binary value = bytes.data();
    const std::size_t size = bytes.size();
    call("fmi3SetBinary", set_binary_, instance_, static_cast<const fmi3ValueReference*>(&reference), std::size_t(1),
         &size, &value, std::size_t(1));
  }
  std::span<const std::uint8_t> get_bytes(std::uint32_t reference) override {
    fmi3Binary value = nullptr;
    std::size_t size = 0;
    call("fmi3GetBinary", get_binary_, instance_, static_cast<const fmi3ValueReference*>(&reference), std::size_t(1),
         &size, &value, std::size_t(1));
    return {value, value ? size : 0};
  }

  StepOutcome do_step(double time, double size) override {
    StepOutcome outcome;
    outcome.last_time = time;
    const Status status =
        status_of("fmi3DoStep", do_step_, instance_, time, size, !setup_.description->can_keep_state,
                  &outcome.needs_event, &outcome.wants_end, &outcome.returned_early, &outcome.last_time);
    if (status == Status::discard) return {.is_discarded = true};  // the other results are undefined then
    if (status != Status::ok && status != Status::warning) fail("fmi3DoStep", status);
    outcome.knows_last_time = outcome.returned_early;
    return outcome;
  }

  void keep_state() override { call("fmi3GetFMUState", get_state_, instance_, &state_); }
  void return_to_state() override { call("fmi3SetFMUState", set_state_, instance_, state_); }
  std::size_t state_size() override {
    std::size_t size = 0;
    call("fmi3SerializedFMUStateSize", state_size_, instance_, state_, &size);
    return size;
  }
  void write_state(std::span<std::uint8_t> bytes) override {
    call("fmi3SerializeFMUState", write_state_, instance_, state_, bytes.data(), bytes.size());
  }
  void read_state(std::span<const std::uint8_t> bytes) override {
    if (state_) call("fmi3FreeFMUState", free_state_, instance_, &state_);
    state_ = nullptr;
    call("fmi3DeserializeFMUState", read_state_, instance_, bytes.data(), bytes.size(), &state_);
    return_to_state();
    is_running_ = true;
  }

 private:
  using Function = void();
  static void* function_of(Function* const (&functions)[std::size(accesses)], Type type) {
    return reinterpret_cast<void*>(functions[std::size_t(type)]);
  }

  void free() {
    if (!instance_) return;
    if (is_corrupt_) {
      abandon(instance_), abandon(state_);
      instance_ = nullptr;
      return;
    }
    if (state_) status_of("fmi3FreeFMUState", free_state_, instance_, &state_);
    if (is_running_) status_of("fmi3Terminate", terminate_, instance_);
    is_running_ = false;
    status_of(
        "fmi3FreeInstance", +[](fmi3FreeInstanceTYPE* f, fmi3Instance c) { return f(c), fmi3OK; }, free_, instance_);
    instance_ = nullptr;
    state_ = nullptr;
  }

  std::string resources_;
  fmi3Instance instance_ = nullptr;
  fmi3FMUState state_ = nullptr;

  fmi3InstantiateCoSimulationTYPE* instantiate_ = nullptr;
  fmi3FreeInstanceTYPE* free_ = nullptr;
  fmi3EnterConfigurationModeTYPE* enter_configuration_ = nullptr;
  fmi3ExitConfigurationModeTYPE* exit_configuration_ = nullptr;
  fmi3EnterInitializationModeTYPE* enter_ = nullptr;
  fmi3ExitInitializationModeTYPE* exit_ = nullptr;
  fmi3TerminateTYPE* terminate_ = nullptr;
  fmi3ResetTYPE* reset_ = nullptr;
  Function* getters_[std::size(accesses)] = {};
  Function* setters_[std::size(accesses)] = {};
  fmi3SetStringTYPE* set_string_ = nullptr;
  fmi3GetBinaryTYPE* get_binary_ = nullptr;
  fmi3SetBinaryTYPE* set_binary_ = nullptr;
  fmi3DoStepTYPE* do_step_ = nullptr;
  fmi3GetFMUStateTYPE* get_state_ = nullptr;
  fmi3SetFMUStateTYPE* set_state_ = nullptr;
  fmi3FreeFMUStateTYPE* free_state_ = nullptr;
  fmi3SerializedFMUStateSizeTYPE* state_size_ = nullptr;
  fmi3SerializeFMUStateTYPE* write_state_ = nullptr;
  fmi3DeserializeFMUStateTYPE* read_state_ = nullptr;
};

}  // namespace

std::unique_ptr<Component> make_component_3(const Component::Setup& setup) {
  return std::make_unique<Component3>(setup);
}

}  // namespace muro::fmu
