// SPDX-License-Identifier: MIT
#include "core/property_store.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/own_values.hpp"

namespace muro {

namespace {

constexpr SlotId no_slot = 0xffffffffu;
constexpr std::uint64_t first_capacity = 8;  ///< elements of a list: the contacts of a vehicle

bool writes(Usage u) { return u.access == Access::write; }

void grow_list(ListHeader* list, std::uint64_t wanted) {
  const std::uint64_t capacity = std::max<std::uint64_t>({wanted, 2 * list->capacity, 8});
  void* memory = std::realloc(list->data, capacity * list->element_size);
  if (!memory) throw std::bad_alloc();
  list->data = memory;
  list->capacity = capacity;
}

std::string_view name_of(Role role) {
  constexpr std::string_view names[] = {"state", "command", "motion_trait"};
  const auto number = static_cast<std::size_t>(role);
  return number < std::size(names) ? names[number] : "unknown";
}

std::string_view name_of(Multiplicity multiplicity) {
  constexpr std::string_view names[] = {"a single value", "an array", "a list"};
  return names[static_cast<int>(multiplicity)];
}

}  // namespace

bool Slot::used_as(Usage usage) const {
  return std::any_of(users.begin(), users.end(), [&](const User& u) { return u.usage == usage; });
}

const Slot::User* Slot::writer() const {
  const auto it = std::find_if(users.begin(), users.end(), [](const User& u) { return writes(u.usage); });
  return it == users.end() ? nullptr : &*it;
}

PropertyStore::PropertyStore() { add_accessor("the set-up"); }

PropertyStore::~PropertyStore() {
  for (ListHeader& list : lists_) std::free(list.data);
}

void PropertyStore::add_object(std::string name) {
  names_.push_back(std::move(name));
  objects_.emplace_back();
}

Accessor PropertyStore::add_accessor(std::string name) {
  accessors_.push_back(std::move(name));
  bound_.emplace_back();
  return Accessor(accessors_.size() - 1);
}

std::string PropertyStore::where(ObjectId object, std::string_view key) const {
  return fmt::format("`{}:{}`", object_name(object), key);
}

std::string PropertyStore::who(Accessor p) const { return accessors_[p]; }

std::uint32_t PropertyStore::column_of(Accessor accessor, const KeyInfo& given) {
  const OwnValues own(given, nullptr, 0);
  const KeyInfo& key = own.key();
  if (key.type->grows && !OwnValues::knows(*key.type))
    problems_.push_back(
        fmt::format("property `{}`: {} declares the type {} as one that grows; only types of the SDK do: use "
                    "MURO_VALUE_TYPE or MURO_OPAQUE_TYPE",
                    key.name, who(accessor), key.type->name));
  const auto it = column_index_.find(key.name);
  if (it == column_index_.end()) {
    columns_.emplace_back(key);
    column_accessor_.push_back(accessor);
    column_index_.emplace(std::string(key.name), std::uint32_t(columns_.size() - 1));
    return std::uint32_t(columns_.size() - 1);
  }
  const KeyInfo& known = columns_[it->second].key();
  const std::string accessors = who(column_accessor_[it->second]) + " and " + who(accessor);
  if (!(*known.type == *key.type))
    problems_.push_back(
        fmt::format("property `{}`: type {} and type {} are declared by {}; give the property of one of them another "
                    "name",
                    key.name, known.type->name, key.type->name, accessors));
  else if (known.unit != key.unit)
    problems_.push_back(
        fmt::format("property `{}`: unit \"{}\" and unit \"{}\" are declared by {}; use one unit, or another name",
                    key.name, known.unit, key.unit, accessors));
  else if (known.role != key.role)
    problems_.push_back(fmt::format(
        "property `{}`: role {} and role {} are declared by {}; declare the key in one place, as the vocabulary does",
        key.name, name_of(known.role), name_of(key.role), accessors));
  else
    return it->second;
  columns_.emplace_back(key);  // memory of the right size, so that the set-up can go on to the next problem
  column_accessor_.push_back(accessor);
  return std::uint32_t(columns_.size() - 1);
}

SlotId PropertyStore::find_id(ObjectId object, std::string_view key) const {
  for (const NamedSlot& n : objects_[index_of(object)])
    if (n.key == key) return n.slot;
  return no_slot;
}

const Slot* PropertyStore::find(ObjectId object, std::string_view key) const {
  const SlotId id = find_id(object, key);
  return id == no_slot ? nullptr : &slots_[id];
}

SlotId PropertyStore::slot_for(Accessor accessor, ObjectId object, const KeyInfo& key) {
  const std::uint32_t column = column_of(accessor, key);
  const SlotId known = find_id(object, key.name);
  if (known != no_slot && *key_of(slots_[known]).type == *key.type) return known;
  const SlotId id = SlotId(slots_.size());
  slots_.emplace_back();
  slots_.back().object = object;
  slots_.back().column = column;
  if (known == no_slot) objects_[index_of(object)].push_back({columns_[column].key().name, id});
  return id;
}

void PropertyStore::reserve(Slot& s, Multiplicity multiplicity, std::uint32_t count) {
  Column& column = columns_[s.column];
  switch (multiplicity) {
    case Multiplicity::single:
      if (!s.place) s.place = column.allocate(1, partition_of(s.object));
      break;
    case Multiplicity::array:
      if (!s.array) s.array = &arrays_.emplace_back();
      if (count > 0 && !s.place) {
        s.place = column.allocate(count, partition_of(s.object));
        s.count = count;
        *s.array = {s.place, count, column.key().type->size};
      }
      break;
    case Multiplicity::list:
      if (!s.place) {
        ListHeader& list = lists_.emplace_back();
        list.grow = &grow_list;
        list.element_size = column.key().type->size;
        list.grow(&list, first_capacity);
        s.place = &list;
        s.count = 0;
      }
      break;
  }
  s.multiplicity = multiplicity;
}

void PropertyStore::set_constant(ObjectId object, const KeyInfo& given, const void* given_data, std::uint32_t count) {
  const OwnValues own(given, given_data, count == single_value ? 1 : count);
  const KeyInfo& key = own.key();
  Slot& s = slots_[slot_for(setup_accessor, object, key)];
  if (s.kind == Slot::Class::variable || s.kind == Slot::Class::derived) {
    problems_.push_back(where(object, key.name) + " is written by " +
                        who(s.writer() ? s.writer()->accessor : setup_accessor) + " and cannot be a constant");
    return;
  }
  const Multiplicity multiplicity = count == single_value ? Multiplicity::single : Multiplicity::array;
  const std::uint32_t elements = multiplicity == Multiplicity::single ? 1 : count;
  if (s.multiplicity != multiplicity || s.count != elements) s.place = nullptr;
  s.kind = Slot::Class::constant;
  s.initialised = true;
  s.count = elements;
  reserve(s, multiplicity, elements);
  if (elements > 0) std::memcpy(s.place, own.data(), std::size_t(elements) * key.type->size);
}

ArrayHeader PropertyStore::constant(ObjectId object, const KeyInfo& key) const {
  const Slot* s = find(object, key.name);
  if (!s || s->kind != Slot::Class::constant || !(*key_of(*s).type == *key.type)) return {};
  return {s->place, s->count, key_of(*s).type->size};
}

void PropertyStore::share(ObjectId a, const KeyInfo& key_a, ObjectId b, const KeyInfo& key_b) {
  const std::string both = where(a, key_a.name) + " and " + where(b, key_b.name);
  if (!(*key_a.type == *key_b.type) || key_a.unit != key_b.unit) {
    problems_.push_back(fmt::format("{} cannot share one place: type {} in \"{}\" and type {} in \"{}\"", both,
                                    key_a.type->name, key_a.unit, key_b.type->name, key_b.unit));
    return;
  }
  SlotId from = find_id(a, key_a.name), to = find_id(b, key_b.name);
  if (from == to && from != no_slot) return;
  if (from != no_slot && to != no_slot) {
    const auto fresh = [&](SlotId id) { return slots_[id].users.empty() && !slots_[id].initialised; };
    if (fresh(to) ||
        (slots_[to].users.empty() && slots_[from].users.empty() && slots_[from].initialised &&
         slots_[from].count == slots_[to].count &&
         std::memcmp(slots_[from].place, slots_[to].place, std::size_t(slots_[to].count) * key_a.type->size) == 0)) {
      std::swap(from, to);
    } else if (!fresh(from)) {
      std::vector<std::string_view> accessors;
      for (const SlotId id : {from, to})
        for (const Slot::User& u : slots_[id].users) accessors.push_back(accessors_[u.accessor]);
      problems_.push_back(
          fmt::format("{} have values of their own already{}; declare the sharing before algorithms connect", both,
                      accessors.empty() ? std::string() : fmt::format(" (bound by {})", fmt::join(accessors, ", "))));
      return;
    }
    for (auto& object : objects_)
      for (NamedSlot& n : object)
        if (n.slot == from) n.slot = to;
    return;
  }
  if (to == no_slot && from != no_slot)
    objects_[index_of(b)].push_back({columns_[column_of(setup_accessor, key_b)].key().name, from});
  else
    objects_[index_of(a)].push_back({columns_[column_of(setup_accessor, key_a)].key().name,
                                     to != no_slot ? to : slot_for(setup_accessor, b, key_b)});
}

void PropertyStore::use(Slot& s, SlotId id, Accessor accessor, Usage usage) {
  s.users.push_back({accessor, usage});
  bound_[accessor].push_back(id);
  if (usage.creation == Creation::state) {
    if (s.kind != Slot::Class::constant) s.kind = Slot::Class::variable;
  } else if (s.kind == Slot::Class::unknown) {
    if (usage.creation == Creation::derived) s.kind = Slot::Class::derived;
    if (usage.access == Access::write && usage.creation == Creation::none) s.kind = Slot::Class::variable;
  }
}

void* PropertyStore::handle(Slot& s, Usage usage) {
  if (usage.access == Access::read_sum) {
    if (!s.sum) s.sum = &sums_.emplace_back();
    *s.sum = {s.contributions.data(), s.contributions.size()};
    return s.sum;
  }
  if (usage.access == Access::accumulate) {
    s.contributions.push_back(columns_[s.column].allocate(1, partition_of(s.object)));
    if (s.sum) *s.sum = {s.contributions.data(), s.contributions.size()};
    return s.contributions.back();
  }
  return s.multiplicity == Multiplicity::array ? static_cast<void*>(s.array) : s.place;
}

void* PropertyStore::bind(Accessor accessor, ObjectId object, const KeyInfo& key, Usage usage,
                          Multiplicity multiplicity, std::uint32_t count, const void* initial, bool inactive) {
  SlotId id = slot_for(accessor, object, key);
  Slot* s = &slots_[id];
  const bool clash = s->place && (s->multiplicity != multiplicity ||
                                  (multiplicity == Multiplicity::array && count > 0 && s->count != count));
  if (clash) {
    const auto shown = [](Multiplicity m, std::uint32_t elements) {
      return m == Multiplicity::array ? fmt::format("{} of {}", name_of(m), elements) : std::string(name_of(m));
    };
    problems_.push_back(fmt::format(
        "{} is {} for {} and {} for {}", where(object, key.name), shown(s->multiplicity, s->count),
        who(s->users.empty() ? setup_accessor : s->users.front().accessor), shown(multiplicity, count), who(accessor)));
    id = SlotId(slots_.size());
    s = &slots_.emplace_back();
    s->object = object;
    s->column = column_of(accessor, key);
  }
  if (usage != usage::accumulate && usage != usage::read_sum) reserve(*s, multiplicity, count);
  const bool creates = usage == usage::variable || usage == usage::derived;
  if (creates && multiplicity == Multiplicity::array && count == 0)
    problems_.push_back(where(object, key.name) + " is created as an array without elements by " + who(accessor));
  if (key.type->grows)
    problems_.push_back(
        fmt::format("{} is used by {}, but its type {} is for constants: ask for it by constant_array()",
                    where(object, key.name), who(accessor), key.type->name));
  if ((writes(usage) || usage == usage::accumulate) && s->kind == Slot::Class::constant)
    problems_.push_back(fmt::format("{} is a constant, but {} writes it", where(object, key.name), who(accessor)));
  use(*s, id, accessor, usage);
  if (initial && s->kind != Slot::Class::constant && (!s->initialised || (usage == usage::variable && !inactive))) {
    std::memcpy(s->place, initial, std::min(key.type->size, key_of(*s).type->size));
    s->initialised = usage == usage::variable || usage == usage::input;  // others only fill what nobody has set
  }
  if (creates) s->object = object;
  return handle(*s, usage);
}

void PropertyStore::let_alternate(const std::vector<ObjectId>& objects, const std::vector<Accessor>& accessors) {
  for (const ObjectId object : objects)
    for (const Accessor accessor : accessors) alternating_.emplace(object, accessor);
}

void* PropertyStore::state_block(Accessor accessor, ObjectId object, std::string_view name, std::uint32_t size) {
  const std::string& key_name = texts_.emplace_back("state." + std::string(name));
  const KeyInfo key{key_name, "1", &value_type<std::uint8_t>, Role::state, "state that only its owner understands"};
  const std::uint32_t rounded = (std::max(size, 1u) + 63) / 64 * 64;  // so that each block is aligned for any type
  const auto* array = static_cast<const ArrayHeader*>(
      bind(accessor, object, key, usage::variable, Multiplicity::array, rounded, nullptr));
  return array->data;
}

PropertyStore::Image PropertyStore::save() const {
  Image image;
  for (const Column& c : columns_)
    if (c.key().type->scalar != Scalar::transient)
      c.each_block([&](std::span<std::byte> b) { image.blocks.emplace_back(b); });
  for (const ListHeader& list : lists_) {
    const auto* first = static_cast<const std::byte*>(list.data);
    image.lists.emplace_back(first, first + list.size * list.element_size);
  }
  return image;
}

void PropertyStore::load(const Image& image) {
  std::vector<std::span<std::byte>> blocks;
  for (const Column& c : columns_)
    if (c.key().type->scalar != Scalar::transient) c.each_block([&](std::span<std::byte> b) { blocks.push_back(b); });
  bool same = blocks.size() == image.blocks.size() && lists_.size() == image.lists.size();
  for (std::size_t i = 0; same && i < blocks.size(); ++i) same = blocks[i].size() == image.blocks[i].size();
  if (!same) throw SetupError("the snapshot is of another simulation: its properties are not those of this one");
  for (std::size_t i = 0; i < blocks.size(); ++i) image.blocks[i].copy_to(blocks[i]);
  for (std::size_t k = 0; k < lists_.size(); ++k) {
    ListHeader& list = lists_[k];
    list.size = image.lists[k].size() / list.element_size;
    if (list.size > list.capacity) list.grow(&list, list.size);
    ++list.revision;
    if (list.size > 0) std::memcpy(list.data, image.lists[k].data(), image.lists[k].size());
  }
}

void PropertyStore::clear(SlotId id) {
  const Slot& s = slots_[id];
  if (!s.place) return;
  if (s.multiplicity == Multiplicity::list) {
    auto& list = *static_cast<ListHeader*>(s.place);
    list.size = 0;
    ++list.revision;
  } else {
    std::memset(s.place, 0, std::size_t(s.count) * key_of(s).type->size);
  }
}

std::uint64_t PropertyStore::hash(ObjectId object) const {
  std::vector<const NamedSlot*> sorted;
  for (const NamedSlot& n : objects_[index_of(object)])
    if (slots_[n.slot].kind == Slot::Class::variable && slots_[n.slot].object == object) sorted.push_back(&n);
  std::sort(sorted.begin(), sorted.end(), [](const NamedSlot* a, const NamedSlot* b) { return a->key < b->key; });
  std::uint64_t h = hash_bytes(object_name(object).data(), object_name(object).size(), 0);
  for (const NamedSlot* n : sorted) {
    const Slot& s = slots_[n->slot];
    h = hash_bytes(n->key.data(), n->key.size(), h);
    const void* data = s.place;
    std::size_t count = s.place ? s.count : 0;
    if (s.multiplicity == Multiplicity::list) {
      const auto* list = static_cast<const ListHeader*>(s.place);
      data = list->data;
      count = list->size;
    }
    h = hash_bytes(data, count * key_of(s).type->size, h);
  }
  return h;
}

}  // namespace muro
