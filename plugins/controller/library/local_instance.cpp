// SPDX-License-Identifier: MIT
#include "local_instance.hpp"

#include <cstring>
#include <new>
#include <utility>

#include "plugins/controller/common/copy_guard/copy_guard.hpp"

namespace muro::control {

namespace {

/// A function of the library has refused; the reason is in the buffer.
struct Refusal {};

}  // namespace

const char* name_of(Function function, bool has_instances) {
  switch (function) {
    case Function::create:
    case Function::resume:
      return has_instances ? "instantiate" : "create";
    case Function::step:
      return "step";
    case Function::destroy:
      break;
  }
  return "destroy";
}

LocalInstance::LocalInstance(const muro_controller_table& table, const InstanceSetup& setup, InstanceMemory memory,
                             LogSink log)
    : table_(table), setup_(setup), memory_(std::move(memory)), log_{log.context, log.write} {
  for (const std::string& text : setup_.arguments) arguments_.push_back(text.c_str());
  arguments_.push_back(nullptr);
  error_[0] = 0;
  connect_ports();
}

LocalInstance::~LocalInstance() {
  try {
    destroy();
  } catch (...) {
    // the instance is gone whatever is thrown
  }
}

void LocalInstance::connect_ports() {
  for (std::uint32_t i = 0; i < table_.input_count; ++i) {
    const PortType type = type_of(table_.inputs[i]);
    void* const at = memory_.inputs[i];
    inputs_.push_back(type == PortType::number ? static_cast<const double*>(at) : nullptr);
    integer_inputs_.push_back(type == PortType::integer ? static_cast<const std::int64_t*>(at) : nullptr);
    const char* const text = memory_.input_sizes[i] > 0 ? static_cast<const char*>(at) : "";  // "": it is missing
    text_inputs_.push_back(type == PortType::text ? text : nullptr);
  }
  for (std::uint32_t i = 0; i < table_.output_count; ++i) {
    const PortType type = type_of(table_.outputs[i]);
    void* const at = memory_.outputs[i];
    outputs_.push_back(type == PortType::number ? static_cast<double*>(at) : nullptr);
    integer_outputs_.push_back(type == PortType::integer ? static_cast<std::int64_t*>(at) : nullptr);
    text_outputs_.push_back(type == PortType::text ? static_cast<char*>(at) : nullptr);
  }
}

void LocalInstance::enter(const char* function) {
  function_ = function;
  error_[0] = 0;
  if (running_) running_->store(function, std::memory_order_relaxed);
  if (!running_text_.empty()) std::strncpy(running_text_.data(), function, running_text_.size() - 1);
}

void LocalInstance::forget_call() {
  running_ = nullptr;
  running_text_ = {};
}

void LocalInstance::require(bool fine) {
  if (!fine) throw Refusal{};
}

void LocalInstance::create(const Call& call) {
  destroy();
  const muro_controller_setup setup{.robot = setup_.robot.c_str(),
                                    .period = call.period,
                                    .seed = call.seed,
                                    .input_sizes = memory_.input_sizes.data(),
                                    .arguments = arguments_.data(),
                                    .output_sizes = memory_.output_sizes.data(),
                                    .index = setup_.index,
                                    .count = setup_.count,
                                    .tunables = setup_.tunables.data(),
                                    .log = &log_};
  if (table_.instantiate) {
    enter("instantiate");
    instance_ = table_.instantiate(&setup, error_, error_size);
    require(instance_ != nullptr);
  } else if (table_.create) {
    enter("create");
    require(table_.create(memory_.state, &setup, error_, error_size) == 0);
  }
}

void LocalInstance::step(const Call& call) {
  void* const state = table_.instantiate ? instance_ : memory_.state;
  muro_controller_step now{.time = call.time,
                           .inputs = inputs_.data(),
                           .outputs = outputs_.data(),
                           .period = call.period,
                           .index = call.index,
                           .input_sizes = memory_.input_sizes.data(),
                           .output_sizes = memory_.output_sizes.data(),
                           .integer_inputs = integer_inputs_.data(),
                           .text_inputs = text_inputs_.data(),
                           .integer_outputs = integer_outputs_.data(),
                           .text_outputs = text_outputs_.data(),
                           .tunables = setup_.tunables.data(),
                           .log = &log_};
  for (std::uint32_t i = 0; i < table_.task_count; ++i) {
    const double steps = steps_between(setup_.task_rates[i], call.period);
    if (call.index % std::uint64_t(steps) != 0) continue;
    enter(table_.tasks[i].name);
    now.period = call.period * steps;
    require(table_.tasks[i].step(state, &now, error_, error_size) == 0);
  }
  now.period = call.period;
  enter("step");
  require(table_.step(state, &now, error_, error_size) == 0);
  if (table_.save) save();
}

void LocalInstance::save() {
  std::size_t size = table_.save_size;
  enter("save");
  require(table_.save(instance_, memory_.state, &size, error_, error_size) == 0);
  if (size > table_.save_size) {
    std::strncpy(error_, "it has written more than its save_size", error_size);
    require(false);
  }
  if (size < *memory_.saved_size)  // so that equal instances leave equal bytes
    std::memset(static_cast<char*>(memory_.state) + size, 0, *memory_.saved_size - size);
  *memory_.saved_size = size;
}

void LocalInstance::load() {
  enter("load");
  require(table_.load(instance_, memory_.state, *memory_.saved_size, error_, error_size) == 0);
}

void LocalInstance::destroy() {
  if (!instance_) return;
  enter("destroy");
  table_.destroy(std::exchange(instance_, nullptr));
}

void LocalInstance::run(const Call& call) {
  switch (call.function) {
    case Function::create:
      create(call);
      break;
    case Function::resume:
      create(call);
      if (table_.load) load();
      break;
    case Function::step:
      step(call);
      break;
    case Function::destroy:
      destroy();
      break;
  }
}

Outcome LocalInstance::call(const Call& call) {
  Outcome outcome;
  const CopyGuard guard;
  running_ = call.running;
  running_text_ = call.running_text;
  try {
    run(call);
  } catch (const Refusal&) {
    error_[error_size - 1] = 0;  // ends the text, whatever the library has written
    outcome.ending = Ending::refused;
    outcome.reason = error_;
  } catch (const std::bad_alloc&) {
    outcome.ending = Ending::out_of_memory;
  } catch (const std::exception& e) {
    outcome.ending = Ending::threw;
    outcome.reason = e.what();
  } catch (...) {
    outcome.ending = Ending::threw;
  }
  CopyGuard::end_copy(function_);
  if (!outcome.is_fine()) outcome.function = function_;
  forget_call();
  return outcome;
}

}  // namespace muro::control
