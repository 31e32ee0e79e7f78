// SPDX-License-Identifier: MIT
#include "core/inspector.hpp"

namespace muro {

namespace {

/// Returns where the elements of a property are now; without data when it has none yet.
LiveProperty elements_of(const Slot& s) {
  LiveProperty p;
  p.multiplicity = s.multiplicity;
  if (s.multiplicity == Multiplicity::array && s.array) {
    p.data = s.array->data;
    p.count = std::uint32_t(s.array->size);
  } else if (s.multiplicity == Multiplicity::list && s.place) {
    const auto& list = *static_cast<const ListHeader*>(s.place);
    p.data = list.data;
    p.count = std::uint32_t(list.size);
  } else if (s.multiplicity == Multiplicity::single) {
    p.data = s.place;
    p.count = 1;
  }
  return p;
}

}  // namespace

std::span<const LiveProperty> Inspector::properties(ObjectId object) noexcept {
  const PropertyStore& store = world_.store();
  properties_.clear();
  keys_.clear();
  for (const PropertyStore::NamedSlot& n : store.properties(object)) {
    const Slot& s = store.slot(n.slot);
    LiveProperty p = elements_of(s);
    if (!p.data && s.multiplicity != Multiplicity::list) continue;  // sums; properties only shared so far
    KeyInfo& key = keys_.emplace_back(store.key_of(s));
    key.name = n.key;
    p.key = &key;
    p.is_constant = s.kind == Slot::Class::constant;
    p.is_variable = s.kind == Slot::Class::variable;
    if (const Slot::User* writer = s.writer()) p.written_by = store.accessor_name(writer->accessor);
    properties_.push_back(p);
  }
  return properties_;
}

std::string_view Inspector::object_name(ObjectId object) const noexcept {
  return index_of(object) < world_.object_count() ? std::string_view(world_.object_name(object)) : "?";
}

std::string_view Inspector::text(TextId id) const noexcept {
  return std::size_t(id) < world_.text_count() ? std::string_view(world_.text(id)) : "?";
}

std::span<const LiveCost> Inspector::costs() noexcept {
  costs_.clear();
  const double seconds_per_tick = scheduler_.seconds_per_tick();
  for (TaskId t = 0; t < scheduler_.tasks().size(); ++t) {
    const Task::Cost cost = scheduler_.cost(t);
    const Task& task = scheduler_.tasks()[t];
    costs_.push_back({task.name, cost.runs, double(cost.ticks) * seconds_per_tick, task.runs_alone});
  }
  return costs_;
}

}  // namespace muro
