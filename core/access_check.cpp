// SPDX-License-Identifier: MIT
#include "core/access_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/instance.hpp"

namespace muro {

namespace {

constexpr std::byte poison_byte{0xff};

std::string call_of(const Task& task, const Step& step, Range range) {
  const Phase phase = task.phases[step.phase];
  if (phase.index_space == Phase::IndexSpace::whole) return fmt::format("phase {}, which is not divided", step.phase);
  return fmt::format("phase {}, for {} {} to {}, with {}", step.phase,
                     phase.index_space == Phase::IndexSpace::robots ? "robots" : "items", range.begin, range.end - 1,
                     phase.scope == Phase::Scope::own_robot ? "Scope::own_robot" : "Scope::reads_all");
}

}  // namespace

AccessCheck::AccessCheck(PropertyStore& store, const std::vector<Instance*>& instances,
                         std::vector<RobotId> robot_of_slot)
    : store_(store), robot_of_slot_(std::move(robot_of_slot)) {
  for (Instance* instance : instances) {
    Bindings b{&instance->algorithm(), &instance->description(), instance->accessor(),
               std::vector<bool>(store.slot_count()), std::vector<bool>(store.slot_count())};
    for (const SlotId s : instance->reads()) b.reads[s] = true;
    for (const SlotId s : instance->writes()) b.reads[s] = b.writes[s] = true;
    bindings_.push_back(std::move(b));
  }
  find_memory();
}

void AccessCheck::find_memory() {
  for (SlotId id = 0; id < store_.slot_count(); ++id) {
    const Slot& s = store_.slot(id);
    const ValueType& type = *store_.key_of(s).type;
    if (s.kind == Slot::Class::constant || type.scalar == Scalar::transient) continue;
    std::size_t contribution = 0;
    for (const Slot::User& u : s.users)
      if (u.usage == usage::accumulate && contribution < s.contributions.size())
        memory_.push_back(
            {id, u.accessor, static_cast<std::byte*>(s.contributions[contribution++]), type.size, nullptr});
    if (!s.place) continue;
    if (s.multiplicity == Multiplicity::list)
      memory_.push_back({id, setup_accessor, nullptr, 0, static_cast<ListHeader*>(s.place)});
    else
      memory_.push_back({id, setup_accessor, static_cast<std::byte*>(s.place), s.count * type.size, nullptr});
  }
}

AccessCheck::Allowed AccessCheck::allowed(const Bindings& bindings, const Task& task, const Step& step,
                                          Range range) const {
  const Phase phase = task.phases[step.phase];
  const bool divided = phase.index_space != Phase::IndexSpace::whole;
  const auto in_range = [&](RobotId robot) {
    if (phase.index_space == Phase::IndexSpace::robots)
      return index_of(robot) >= range.begin && index_of(robot) < range.end;
    const auto& robots = task.robot_of_item;
    return std::find(robots.begin() + range.begin, robots.begin() + range.end, robot) != robots.begin() + range.end;
  };
  Allowed a{std::vector<bool>(memory_.size()), std::vector<bool>(memory_.size())};
  for (std::size_t i = 0; i < memory_.size(); ++i) {
    const Memory& m = memory_[i];
    const RobotId robot = robot_of_slot_[m.slot];
    const bool own = !divided || robot == no_robot || in_range(robot);
    const bool of_another = m.contributor != setup_accessor && m.contributor != bindings.accessor;
    a.writes[i] = bindings.writes[m.slot] && own && !of_another;
    a.reads[i] = bindings.reads[m.slot] && (own || phase.scope == Phase::Scope::reads_all);
  }
  return a;
}

AccessCheck::Copy AccessCheck::copy() const {
  Copy all;
  for (const Memory& m : memory_) all.emplace_back(m.bytes().begin(), m.bytes().end());
  return all;
}

void AccessCheck::restore(const Copy& from) {
  for (std::size_t i = 0; i < memory_.size(); ++i) {
    if (ListHeader* list = memory_[i].list) {
      list->size = from[i].size() / list->element_size;
      if (list->size > list->capacity) list->grow(list, list->size);
      ++list->revision;
    }
    std::copy(from[i].begin(), from[i].end(), memory_[i].bytes().begin());
  }
}

void AccessCheck::poison(const Allowed& allowed) {
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (!allowed.reads[i] && !allowed.writes[i]) std::ranges::fill(memory_[i].bytes(), poison_byte);
}

std::string AccessCheck::name_of(const Memory& memory) const {
  const Slot& s = store_.slot(memory.slot);
  return fmt::format("`{}:{}`", store_.object_name(s.object), store_.key_of(s).name);
}

/// Repeats a step from its start to the begin of a call: only values that its phases have passed on are there again.
bool AccessCheck::repeat_until(const Task& task, Step step, Range range, abi::ErrorText& error) {
  restore(before_step_);
  if (!task.instance->restored(error)) return false;
  restore(before_step_);  // derived values may have been cleared
  const std::uint32_t phase = step.phase;
  for (step.phase = 0; step.phase < phase; ++step.phase)
    if (!task.instance->step(step, {0, task.length(step.phase)}, error)) return false;
  return range.begin == 0 || task.instance->step(step, {0, range.begin}, error);
}

bool AccessCheck::call(const Task& task, const Step& step, Range range, abi::ErrorText& error) {
  const auto found =
      std::find_if(bindings_.begin(), bindings_.end(), [&](const Bindings& b) { return b.algorithm == task.instance; });
  if (found == bindings_.end()) return task.instance->step(step, range, error);  // hand-over, and level filters
  const Allowed may = allowed(*found, task, step, range);
  const Copy before = copy();
  if (step.phase == 0 && range.begin == 0) before_step_ = before;
  if (!task.instance->step(step, range, error)) return false;
  const Copy after = copy();
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (!may.writes[i] && after[i] != before[i]) {
      error.set(
          fmt::format("it wrote {}, which it has no right to in {}", name_of(memory_[i]), call_of(task, step, range)));
      return false;
    }
  const Description& d = *found->description;
  const bool talks = (d.capabilities & Capability::runs_alone) != 0;  // to programs that say a thing once
  const bool repeats = (d.capabilities & Capability::restorable) != 0 && d.kind != Kind::recorder && !talks;
  if (!repeats) return true;

  if (!repeat_until(task, step, range, error)) return false;
  restore(before);
  poison(may);
  const bool fine = task.instance->step(step, range, error);
  const Copy again = copy();
  restore(after);
  const auto report = [&](const std::string& what) {
    error.set(
        fmt::format("{} in {}, when made again with all poisoned that it has not declared to read: it reads in secret, "
                    "or keeps state outside of properties",
                    what, call_of(task, step, range)));
    return false;
  };
  if (!fine) return report(fmt::format("it failed ({})", error.view()));
  for (std::size_t i = 0; i < memory_.size(); ++i)
    if (may.writes[i] && again[i] != after[i])
      return report(fmt::format("it wrote {} differently", name_of(memory_[i])));
  return true;
}

}  // namespace muro
