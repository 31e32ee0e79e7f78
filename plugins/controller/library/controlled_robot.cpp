// SPDX-License-Identifier: MIT
#include "controlled_robot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "local_instance.hpp"
#include "muro/base/number_text.hpp"
#include "muro/base/random.hpp"
#include "muro/vocabulary/radio.hpp"
#include "outcome_text.hpp"
#include "plugins/common/text/counted.hpp"
#include "plugins/common/text/one_line.hpp"
#include "plugins/common/text/quote.hpp"
#include "remote_instance.hpp"

namespace muro::control {

namespace {

std::uint64_t seed_of(std::uint64_t simulation, std::uint64_t robot) {
  return fnv1a({reinterpret_cast<const char*>(&simulation), sizeof simulation}, robot ^ 0xcbf29ce484222325ull);
}

std::span<const TextId> constant_texts(const Connector& c, const FoundProperty& found) {
  return c.constant_array(found.object, Key<TextId>(found.key->name, found.key->unit, ""));
}

ObjectNames names_of_objects(const Connector& c) {
  auto names = std::make_shared<std::vector<std::string>>();
  for (std::uint32_t o = 0; o < c.object_count(); ++o) names->emplace_back(c.object_name(ObjectId{o}));
  return names;
}

}  // namespace

ControlledRobot::ControlledRobot(const ControlSettings& settings, std::string name, std::uint32_t item,
                                 std::uint32_t count, std::uint64_t random_key, StateBlock* block)
    : settings_(settings), name_(std::move(name)), item_(item), count_(count), random_key_(random_key), block_(block) {}

std::string ControlledRobot::about(const muro_port& port, bool input) const {
  return "robot `" + name_ + "`: " + (input ? "input" : "output") + " `" + port.name + "` of `" + settings_.table.name +
         "`";
}
std::string ControlledRobot::about() const { return "robot `" + name_ + "`: `" + settings_.table.name + "` "; }

void ControlledRobot::note(const char* function) const {
  if (!settings_.notes) return;
  CallNote& here = settings_.notes->of_this_thread();
  here.set_item(item_);
  here.set_library(function ? settings_.path.c_str() : nullptr, function);
}

void ControlledRobot::write_log(void* context, std::uint32_t level, const char* text) {
  const auto& self = *static_cast<const ControlledRobot*>(context);
  if (!text) return;
  constexpr LogLevel levels[] = {LogLevel::debug, LogLevel::info, LogLevel::warning, LogLevel::error};
  self.settings_.host->log(levels[std::min(level, 3u)], self.about() + "says: " + one_line(text));
}

// --- set-up

void ControlledRobot::create_own_properties(Connector& c, ObjectId object) {
  for (const muro_port& p : settings_.table.outputs) {
    if (!has_flag(p, MURO_PORT_OWN)) continue;
    const char* const unit = p.unit ? p.unit : "1";
    constexpr const char* doc = "written by control code, for others";
    if (type_of(p) == PortType::text)
      c.variable_array(object, Key<std::uint8_t>(p.name, unit, doc), p.size);
    else if (type_of(p) == PortType::integer)
      c.variable_array(object, Key<std::int64_t>(p.name, unit, doc), p.size);
    else
      c.variable_array(object, Key<double>(p.name, unit, doc), p.size);
  }
}

void ControlledRobot::check_tasks(double rate) const {
  for (std::size_t i = 0; i < settings_.task_rates.size(); ++i) {
    const std::string task = settings_.table.tasks[i].name;
    if (rate == 0)
      throw Error(about() + "runs on demand, and its task " + quote(task) + " at a rate; give it a `rate`");
    const double wanted = settings_.task_rates[i], steps = rate / wanted;
    if (steps > 1 - 1e-9 && std::abs(steps - std::nearbyint(steps)) < 1e-5 * steps)
      continue;  // same tolerance as the precision of the message
    throw Error(about() + "runs at " + number_text(rate) + " Hz, and its task " + quote(task) + " is to run at " +
                number_text(wanted) +
                " Hz; the rate of a task is a whole fraction of the controller's, set `rate` or `rates: [\"" + task +
                "=" + number_text(rate / std::max(1.0, std::ceil(steps))) + "\"]`");
  }
}

std::vector<std::string> ControlledRobot::connect(Connector& c, const RobotObjects& objects, const Connections& inputs,
                                                  const Connections& outputs) {
  check_tasks(c.rate());
  const PropertyFinder finder(c, c.items()[item_], objects);
  std::vector<std::string> missing;
  for (const muro_port& port : settings_.table.inputs) {
    inputs_.push_back(connect_port(c, finder, port, inputs, true));
    if (inputs_.back().is_missing()) missing.emplace_back(port.name);
  }
  for (const muro_port& port : settings_.table.outputs)
    outputs_.push_back(connect_port(c, finder, port, outputs, false));
  return missing;
}

Port ControlledRobot::connect_port(Connector& c, const PropertyFinder& finder, const muro_port& port,
                                   const Connections& connections, bool input) {
  Port bound(type_of(port), port.size);
  const bool may_be_missing = input && has_flag(port, MURO_PORT_OPTIONAL) && !connections.contains(port.name);
  if (may_be_missing && !finder.has(port.name)) return bound;
  try {
    for (const PortProperty& p : finder.find(port, input, connections)) {
      const FoundProperty& found = p.found;
      if (p.leader >= 0) {
        bound.add_follower(std::size_t(p.leader), p.multiplier, p.offset);
        notes_.push_back(about(port, input) + ": what it writes to " +
                         quote(std::string(c.object_name(found.object)) + ":" + std::string(found.key->name)) +
                         " is left out, for the joint follows " + finder.leader_of(p) + " (a mimic joint)");
        continue;
      }
      if (input && bound.type() == PortType::text && *found.key->type == value_type<TextId>) {
        for (const TextId id : constant_texts(c, found)) bound.add_text(std::string(c.text(id)));
        continue;
      }
      if (input) doubt_if_too_slow(c, found, port);
      void* const handle = input ? const_cast<void*>(c.read_any(found)) : c.write_any(found);
      if (bound.type() == PortType::text && *found.key->type == value_type<ObjectId>)
        bound.add_objects(found, handle, names_of_objects(c));
      else
        bound.add(found, handle);
    }
  } catch (const Error& e) {
    throw Error(about(port, input) + " cannot be connected: " + e.what());
  }
  return bound;
}

/// Notes when radio messages may be missed: each is listed for a limited time, and may vanish between two steps.
void ControlledRobot::doubt_if_too_slow(const Connector& c, const FoundProperty& found, const muro_port& port) {
  if (found.key->name != keys::radio_received.name || !(c.rate() > 0)) return;
  const std::optional<double> keep = c.constant(found.object, keys::radio_keep);
  const double period = 1 / c.rate();
  if (!keep || *keep >= period * (1 - 1e-9)) return;
  doubts_.push_back(about(port, true) + " is read at " + number_text(c.rate()) + " Hz, but " +
                    quote(c.object_name(found.object)) + " lists a message for " + number_text(*keep) +
                    " s alone: those that come and go in between are missed; set `keep: " + number_text(period) +
                    "` at the radio");
}

void ControlledRobot::check_size(const Port& port, const muro_port& wanted, bool input) const {
  if (!input && port.type() == PortType::text && !port.has_room_for_text())
    throw Error(about(wanted, input) + " has " + counted(wanted.size, "byte") +
                " in the library, which is more than the connected property has");
  if (wanted.size == 0 || port.size() == wanted.size || port.is_missing()) return;
  throw Error(about(wanted, input) + " has " + counted(wanted.size, "number") +
              " in the library, but the connected properties have " + std::to_string(port.size()));
}

void ControlledRobot::measure() {
  std::size_t words = 0;
  const auto add = [&](Port& port, const muro_port& wanted, bool input) {
    port.resolve();
    check_size(port, wanted, input);
    if (!input || !port.direct()) words += (port.bytes() + 7) / 8;
  };
  for (std::size_t i = 0; i < inputs_.size(); ++i) add(inputs_[i], settings_.table.inputs[i], true);
  for (std::size_t i = 0; i < outputs_.size(); ++i) add(outputs_[i], settings_.table.outputs[i], false);
  if (settings_.functions) copies_.assign(words, 0);
}

/// Returns the data of an instance in this process. Contiguous inputs are used directly. Outputs are copies, so that a
/// failed step has no effect.
InstanceMemory ControlledRobot::own_memory() {
  InstanceMemory m;
  std::uint64_t* next = copies_.data();
  const auto data_of = [&](const Port& port, bool input) -> void* {
    if (input && port.direct()) return port.direct();
    return std::exchange(next, next + (port.bytes() + 7) / 8);
  };
  for (const Port& p : inputs_) m.inputs.push_back(data_of(p, true)), m.input_sizes.push_back(p.size());
  for (const Port& p : outputs_) m.outputs.push_back(data_of(p, false)), m.output_sizes.push_back(p.size());
  m.state = block_->state();
  m.saved_size = &block_->saved_size;
  return m;
}

void ControlledRobot::make_instance() {
  const InstanceSetup setup{.robot = name_,
                            .index = item_,
                            .count = count_,
                            .arguments = settings_.arguments,
                            .tunables = settings_.tunables,
                            .task_rates = settings_.task_rates};
  const LogSink log{this, &ControlledRobot::write_log};
  if (settings_.functions) {
    instance_ = std::make_unique<LocalInstance>(*settings_.functions, setup, own_memory(), log);
    return;
  }
  if (!process_) process_ = std::make_unique<ControlProcess>(settings_.path, settings_.limits);
  instance_ = std::make_unique<RemoteInstance>(std::move(process_), settings_.table, setup, inputs_, outputs_, log);
}

void ControlledRobot::start() {
  if (failures_) failures_->begin_anew();
  failure_count_ = 0;
  if (!instance_) {
    measure();
    try {
      make_instance();
    } catch (const ProcessError& e) {
      throw Error(about() + e.what());
    }
  } else if (block_->created == 0 && settings_.table.has_instances) {
    instance_->call({.function = Function::destroy});
  }
  is_stale_ = false;
}

void ControlledRobot::restored() {
  if (block_->created != 0 && !settings_.table.is_restorable())
    throw Error(about() +
                "cannot go on from a snapshot: its instances have memory of their own, and its table has no functions "
                "`save` and `load`; add them, or reset the simulation");
  is_stale_ = settings_.table.has_instances;
  if (failures_) failures_->begin_anew();
}

// --- steps

void ControlledRobot::read_ports(InstanceMemory& m) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (m.inputs[i] != inputs_[i].direct() || !m.inputs[i]) m.input_sizes[i] = inputs_[i].read(m.inputs[i]);
  for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i].read(m.outputs[i]);
  if (m.state == block_->state()) return;
  if (settings_.table.state_size > 0) std::memcpy(m.state, block_->state(), settings_.table.state_size);
  *m.saved_size = block_->saved_size;
}

bool ControlledRobot::write_ports(const InstanceMemory& m, std::string& why_not) const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    std::uint32_t bad = 0;
    if (outputs_[i].write(m.outputs[i], bad)) continue;
    const muro_port& port = settings_.table.outputs[i];
    if (outputs_[i].type() == PortType::text) {
      why_not = about(port, false) + " has no closing zero within its " + std::to_string(outputs_[i].size()) + " bytes";
    } else if (outputs_[i].type() == PortType::integer) {
      why_not = about(port, false) + "[" + std::to_string(bad) + "] is " +
                std::to_string(static_cast<const std::int64_t*>(m.outputs[i])[bad]) +
                ", which does not fit into its property";
    } else {
      const double value = static_cast<const double*>(m.outputs[i])[bad];
      char number[32];
      std::snprintf(number, sizeof number, "%.17g", value);
      why_not = about(port, false) + "[" + std::to_string(bad) + "] is " +
                (std::isnan(value) ? "not a number" : number) +
                (std::isfinite(value) ? ", which does not fit into its property" : "; outputs must be finite numbers");
    }
    return false;
  }
  if (m.state == block_->state()) return true;
  if (settings_.table.state_size > 0) std::memcpy(block_->state(), m.state, settings_.table.state_size);
  block_->saved_size = *m.saved_size;
  return true;
}

/// Calls the control code. This is the only place that does so, and that learns how a call has ended.
Outcome ControlledRobot::outcome_of(Call& call, const Step& step) {
  if (failures_) {
    if (const Outcome* recorded = failures_->replayed(step.time, call.function)) return *recorded;
    call.is_patient = failures_->is_replayed();
  }
  note(name_of(call.function, settings_.table.has_instances));
  if (settings_.notes) call.running = &settings_.notes->of_this_thread().function;
  Outcome outcome = instance_->call(call);
  note(nullptr);
  if (failures_ && !outcome.is_fine()) failures_->record(step.time, call.function, outcome, about());
  return outcome;
}

/// Returns false when the control code has failed and the run goes on.
bool ControlledRobot::call(Call& call, const Step& step) {
  const Outcome outcome = outcome_of(call, step);
  if (outcome.is_fine()) return true;
  fail(about() + text_of(outcome, !settings_.functions, settings_.limits), outcome.stack);
  return false;
}

void ControlledRobot::report(ReportEntries& report) const {
  if (failure_count_ == 0) return;
  const std::string name = name_ + "/" + settings_.table.name;
  const auto tell = [&](std::string_view key, std::uint64_t value) {
    report.set({"control_code", name, key, double(value)});
  };
  tell("failures", failure_count_);
  tell("restarts", block_->restarts);
  tell("held", block_->is_held);
}

void ControlledRobot::fail(std::string what, const std::string& stack) {
  ++failure_count_;
  if (!stack.empty()) settings_.host->log(LogLevel::error, about() + "was in these calls:\n" + stack);
  const bool may_restart = settings_.on_failure == OnFailure::restart && block_->restarts < settings_.restarts;
  if (settings_.on_failure == OnFailure::stop) throw Error(what);
  for (const Port& p : outputs_) p.rest();
  block_->created = 0;
  block_->saved_size = 0;
  if (settings_.table.state_size > 0) std::memset(block_->state(), 0, settings_.table.state_size);
  instance_.reset();
  if (may_restart) {
    ++block_->restarts;
    what += "; it begins anew, for the " + std::to_string(block_->restarts) + ". of " +
            std::to_string(settings_.restarts) + " times (`on_failure: restart`)";
  } else {
    block_->is_held = 1;
    what += "; from now on its commands of speed and effort are 0, and all others stay (`on_failure: " +
            std::string(settings_.on_failure == OnFailure::hold ? "hold`)" : "restart`, `restarts` are used up)");
  }
  settings_.host->log(LogLevel::warning, what);
}

void ControlledRobot::step(const Step& step) {
  if (block_->is_held != 0) return;
  if (!instance_ || !instance_->is_alive()) {
    try {
      make_instance();
    } catch (const ProcessError& e) {
      if (failures_) failures_->tell_not_repeatable(about() + e.what());
      return fail(about() + e.what(), "");
    }
    is_stale_ = settings_.table.has_instances;
  }
  InstanceMemory& m = instance_->memory();
  read_ports(m);
  Call call{.time = step.seconds(), .period = step.dt, .seed = seed_of(step.seed, random_key_), .index = step.index};
  const bool begins = block_->created == 0;
  if (begins || is_stale_) {
    call.function = begins ? Function::create : Function::resume;
    if (!this->call(call, step)) return;
    is_stale_ = false;
  }
  call.function = Function::step;
  if (!this->call(call, step)) return;
  std::string why_not;
  if (!write_ports(m, why_not)) return fail(std::move(why_not), "");
  block_->created = 1;
}

}  // namespace muro::control
