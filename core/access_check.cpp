// SPDX-License-Identifier: MIT
#include "core/access_check.hpp"

#include <algorithm>
#include <cstring>

#include "core/instance.hpp"

namespace muro {

namespace {

constexpr std::byte poison_byte{0xff};

std::string call_of(const Task& task, const Step& step, Range range) {
  const Phase phase = task.phases[step.phase];
  std::string text = "phase " + std::to_string(step.phase);
  if (phase.index_space == Phase::IndexSpace::whole) return text + ", which is not divided";
  return text + ", for " + (phase.index_space == Phase::IndexSpace::robots ? "robots " : "items ") +
         std::to_string(range.begin) + " to " + std::to_string(range.end - 1) + ", with " +
         (phase.scope == Phase::Scope::own_robot ? "Scope::own_robot" : "Scope::reads_all");
}

}  // namespace

AccessCheck::AccessCheck(PropertyStore& store, const std::vector<Instance*>& instances,
                         std::vector<std::int32_t> robot_of_slot)
    : store_(store), robot_of_slot_(std::move(robot_of_slot)) {
  for (Instance* instance : instances) {
    Rights r{&instance->algorithm(), &instance->description(), instance->accessor(),
             std::vector<bool>(store.slot_count()), std::vector<bool>(store.slot_count())};
    for (const SlotId s : instance->reads()) r.reads[s] = true;
    for (const SlotId s : instance->writes()) r.reads[s] = r.writes[s] = true;
    rights_.push_back(std::move(r));
  }
  find_cells();
}

void AccessCheck::find_cells() {
  for (SlotId id = 0; id < store_.slot_count(); ++id) {
    const Slot& s = store_.slot(id);
    const ValueType& type = *store_.key_of(s).type;
    if (s.kind == Slot::Class::constant || type.scalar == Scalar::transient) continue;
    std::size_t part = 0;
    for (const Slot::User& u : s.users)
      if (u.usage == usage::accumulate && part < s.parts.size())
        cells_.push_back({id, u.accessor, static_cast<std::byte*>(s.parts[part++]), type.size, nullptr});
    if (!s.place) continue;
    if (s.multiplicity == Multiplicity::list)
      cells_.push_back({id, setup_accessor, nullptr, 0, static_cast<ListHeader*>(s.place)});
    else
      cells_.push_back({id, setup_accessor, static_cast<std::byte*>(s.place), s.count * type.size, nullptr});
  }
}

AccessCheck::Allowed AccessCheck::allowed(const Rights& rights, const Task& task, const Step& step, Range range) const {
  const Phase phase = task.phases[step.phase];
  const bool divided = phase.index_space != Phase::IndexSpace::whole;
  const auto in_range = [&](std::int32_t robot) {
    if (phase.index_space == Phase::IndexSpace::robots)
      return robot >= std::int32_t(range.begin) && robot < std::int32_t(range.end);
    const auto& robots = task.robot_of_item;
    return std::find(robots.begin() + range.begin, robots.begin() + range.end, robot) != robots.begin() + range.end;
  };
  Allowed a{std::vector<bool>(cells_.size()), std::vector<bool>(cells_.size())};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& c = cells_[i];
    const std::int32_t robot = robot_of_slot_[c.slot];
    const bool own = !divided || robot < 0 || in_range(robot);
    const bool others_part = c.adder != setup_accessor && c.adder != rights.accessor;
    a.writes[i] = rights.writes[c.slot] && own && !others_part;
    a.reads[i] = rights.reads[c.slot] && (own || phase.scope == Phase::Scope::reads_all);
  }
  return a;
}

AccessCheck::Copy AccessCheck::copy() const {
  Copy all;
  for (const Cell& c : cells_) all.emplace_back(c.bytes().begin(), c.bytes().end());
  return all;
}

void AccessCheck::put_back(const Copy& from) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (ListHeader* list = cells_[i].list) {
      list->size = from[i].size() / list->element_size;
      if (list->size > list->capacity) list->grow(list, list->size);
      ++list->revision;
    }
    std::copy(from[i].begin(), from[i].end(), cells_[i].bytes().begin());
  }
}

void AccessCheck::poison(const Allowed& allowed) {
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (!allowed.reads[i] && !allowed.writes[i]) std::ranges::fill(cells_[i].bytes(), poison_byte);
}

std::string AccessCheck::name_of(const Cell& cell) const {
  const Slot& s = store_.slot(cell.slot);
  return "`" + store_.object_name(s.object) + ":" + std::string(store_.key_of(s).name) + "`";
}

/// From the state before the step to where a call begins: what phases hand on is there again, and nothing older.
bool AccessCheck::come_again(const Task& task, Step step, Range range, abi::ErrorText& error) {
  put_back(before_step_);
  if (!task.instance->restored(error)) return false;
  put_back(before_step_);  // what is derived may have been cleared
  const std::uint32_t phase = step.phase;
  for (step.phase = 0; step.phase < phase; ++step.phase)
    if (!task.instance->step(step, {0, task.length(step.phase)}, error)) return false;
  return range.begin == 0 || task.instance->step(step, {0, range.begin}, error);
}

bool AccessCheck::make(const Task& task, const Step& step, Range range, abi::ErrorText& error) {
  const auto found =
      std::find_if(rights_.begin(), rights_.end(), [&](const Rights& r) { return r.algorithm == task.instance; });
  if (found == rights_.end()) return task.instance->step(step, range, error);  // hand-over, and what it keeps
  const Rights& rights = *found;
  const Allowed may = allowed(rights, task, step, range);
  const Copy before = copy();
  if (step.phase == 0 && range.begin == 0) before_step_ = before;
  if (!task.instance->step(step, range, error)) return false;
  const Copy after = copy();
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (!may.writes[i] && after[i] != before[i]) {
      error.set("it wrote " + name_of(cells_[i]) + ", which it has no right to in " + call_of(task, step, range));
      return false;
    }
  const Description& d = *rights.description;
  const bool repeats =
      (d.capabilities & Capability::restorable) != 0 && d.kind != Kind::recorder && d.kind != Kind::view;
  if (!repeats) return true;

  if (!come_again(task, step, range, error)) return false;
  put_back(before);
  poison(may);
  const bool fine = task.instance->step(step, range, error);
  const Copy again = copy();
  put_back(after);
  const auto tell = [&](const std::string& what) {
    error.set(what + " in " + call_of(task, step, range) +
              ", when made again with all poisoned that it has not declared to read: it reads in secret, or keeps "
              "state outside of properties");
    return false;
  };
  if (!fine) return tell("it failed (" + std::string(error.view()) + ")");
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (may.writes[i] && again[i] != after[i]) return tell("it wrote " + name_of(cells_[i]) + " differently");
  return true;
}

}  // namespace muro
