// SPDX-License-Identifier: MIT
#include "core/instance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "muro/toolkit/random.hpp"

namespace muro {

namespace {

bool reads_alone(Usage u) { return u.access == Access::read || u.access == Access::read_sum; }

}  // namespace

Instance::Instance(const abi::AlgorithmEntry& entry, AlgorithmSetup setup, World& world, Host& host)
    : entry_(entry),
      setup_(std::move(setup)),
      world_(world),
      host_(host),
      parameters_(*entry.description, setup_),
      accessor_(world.store().add_accessor(
          fmt::format("{} ({}{}{})", setup_.name, setup_.use, setup_.place.empty() ? "" : ", ", setup_.place))) {
  if (setup_.items.empty()) setup_.items.push_back({});
  for (const AlgorithmSetup::ItemSetup& item : setup_.item_setups) {
    AlgorithmSetup one;
    one.name = item.name, one.use = setup_.use, one.place = item.place, one.parameters = item.parameters;
    item_parameters_.emplace_back(*entry.description, one);
  }
  const Kind kind = entry.description->kind;
  if (!setup_.items.front().robot && (kind == Kind::motion || kind == Kind::kinematics || kind == Kind::drive))
    throw SetupError(
        fmt::format("{}{} ({}) serves robots, but no robot is named; use it in a robot, not for the whole scene",
                    prefix_of(setup_.place), setup_.name, setup_.use));
  abi::ErrorText error;
  algorithm_ = entry_.create(&error);
  require(algorithm_ != nullptr, error, "cannot be created");
}

Instance::~Instance() {
  if (algorithm_) algorithm_->destroy();
}

void Instance::require(bool fine, const abi::ErrorText& error, const char* doing) const {
  if (fine) return;
  throw SetupError(
      fmt::format("{}{} ({}) {}: {}", prefix_of(setup_.place), setup_.name, setup_.use, doing, error.view()));
}

void Instance::connect() {
  abi::ErrorText error;
  require(algorithm_->connect(*this, error), error, "cannot be connected");
}

void Instance::connect_by_name() {
  abi::ErrorText error;
  require(algorithm_->connect_by_name(*this, error), error, "cannot be connected");
}

void Instance::start() {
  abi::ErrorText error;
  require(algorithm_->start(error), error, "cannot start");
}

void Instance::restored() {
  abi::ErrorText error;
  require(algorithm_->restored(error), error, "cannot go on from the restored state");
}

void Instance::finish() {
  abi::ErrorText error;
  require(algorithm_->finish(error), error, "cannot finish");
}

void Instance::on_handover(std::uint32_t item) {
  abi::ErrorText error;
  require(algorithm_->on_handover(item, error), error, "cannot take the robot over");
}

std::vector<SlotId> Instance::reads() const {
  std::vector<SlotId> slots;
  for (const Bound& b : bound_)
    if (reads_alone(b.usage)) slots.push_back(b.slot);
  return slots;
}

std::vector<SlotId> Instance::writes() const {
  std::vector<SlotId> slots;
  for (const Bound& b : bound_)
    if (!reads_alone(b.usage)) slots.push_back(b.slot);
  return slots;
}

void Instance::add_indirect_reads(const std::vector<const Instance*>& by_accessor) {
  std::vector<Bound> added;
  for (const Bound& b : bound_) {
    const Slot& s = world_.store().slot(b.slot);
    const Slot::User* writer = s.writer();
    if (world_.store().key_of(s).type->scalar != Scalar::transient || !writer || writer->accessor == accessor_)
      continue;
    for (const SlotId slot : by_accessor[writer->accessor]->reads()) added.push_back({slot, usage::read});
  }
  bound_.insert(bound_.end(), added.begin(), added.end());
}

std::vector<SlotAccess> Instance::accesses() const {
  std::vector<SlotAccess> all;
  for (const Bound& b : bound_) {
    if (world_.store().slot(b.slot).kind == Slot::Class::constant) continue;
    const bool shared = b.usage.access == Access::read || b.usage.access == Access::accumulate;
    all.push_back({b.slot, !shared});
  }
  merge_accesses(all);
  return all;
}

std::vector<Phase> Instance::phases() const {
  const std::span<const Phase> given = algorithm_->phases();
  if (!given.empty()) return {given.begin(), given.end()};
  const bool batched = (description().capabilities & Capability::batched) != 0;
  return {{batched ? Phase::IndexSpace::items : Phase::IndexSpace::whole, Phase::Scope::reads_all}};
}

std::uint64_t Instance::random_key(std::uint32_t i) const noexcept {
  return fnv1a(setup_.subsystem, fnv1a(world_.object_name(setup_.items[i].object)));
}

std::string_view Instance::resolve_path(std::string_view path) const noexcept {
  namespace fs = std::filesystem;
  const fs::path given(path);
  const fs::path base = setup_.folder.empty() ? fs::current_path() : fs::path(setup_.folder);
  return paths_.emplace_back((given.is_absolute() ? given : fs::absolute(base) / given).lexically_normal().string());
}

std::span<const FoundProperty> Instance::properties(ObjectId object) const noexcept {
  found_.clear();
  for (const PropertyStore::NamedSlot& n : world_.store().properties(object)) {
    const Slot& s = world_.store().slot(n.slot);
    const KeyInfo* key = &world_.store().key_of(s);
    const bool is_sum = std::any_of(s.users.begin(), s.users.end(), [](const Slot::User& u) {
      return u.usage.access == Access::accumulate || u.usage.access == Access::read_sum;
    });
    if (!s.place && !s.array && !is_sum) continue;  // what has only been shared so far
    if (key->name != n.key) {                       // shared with a property of another name
      aliases_.push_back(*key);
      aliases_.back().name = n.key;
      key = &aliases_.back();
    }
    const bool open = !is_sum && (s.multiplicity == Multiplicity::list || !s.place);
    found_.push_back({object, key, s.multiplicity, open ? 0 : s.count, s.kind == Slot::Class::constant, is_sum});
  }
  return found_;
}

bool Instance::is_used(ObjectId object, const KeyInfo& key, Usage usage) const noexcept {
  const Slot* s = world_.store().find(object, key.name);
  return s && s->used_as(usage);
}

void* Instance::bind(ObjectId object, const KeyInfo& key, Usage usage, Multiplicity multiplicity, std::uint32_t count,
                     const void* initial) noexcept {
  const std::int32_t robot = world_.robot_of(object);
  const bool inactive =
      robot >= 0 && std::size_t(robot) < inactive_at_start_.size() && inactive_at_start_[std::size_t(robot)];
  void* handle = world_.store().bind(accessor_, object, key, usage, multiplicity, count, initial, inactive);
  bound_.push_back({world_.store().slots_of(accessor_).back(), usage});
  return handle;
}

void* Instance::state_block(ObjectId object, std::string_view name, std::uint32_t size) noexcept {
  void* block = world_.store().state_block(accessor_, object, name, size);
  bound_.push_back({world_.store().slots_of(accessor_).back(), usage::variable});
  return block;
}

ArrayHeader Instance::constant_raw(ObjectId object, const KeyInfo& key) const noexcept {
  return world_.store().constant(object, key);
}

void Instance::set_raw(ObjectId object, const KeyInfo& key, const void* value) noexcept {
  world_.store().set_constant(object, key, value, single_value);
}

}  // namespace muro
