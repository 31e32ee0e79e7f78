// SPDX-License-Identifier: MIT
#include "core/instance.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>

#include "core/error.hpp"
#include "muro/base/random.hpp"

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
    one.parameter_places = item.parameter_places;
    item_parameters_.emplace_back(*entry.description, one);
  }
  const Kind kind = entry.description->kind;
  if (!setup_.items.front().robot && (kind == Kind::motion || kind == Kind::kinematics || kind == Kind::drive))
    throw SetupError(
        fmt::format("{}{} ({}) serves robots, but no robot is named; use it in a robot, not for the whole scene",
                    prefix_of(setup_.place), setup_.name, setup_.use));
  callee_ = make_callee();
  const CallScope scope(*callee_, "create");
  abi::ErrorText error;
  algorithm_ = entry_.create(&error);
  require(algorithm_ != nullptr, error, "cannot be created");
}

Instance::~Instance() {
  if (!algorithm_) return;
  const CallScope scope(*callee_, "destroy");
  algorithm_->destroy();
}

/// The library is the one that contains the plugin's own function.
std::shared_ptr<const Callee> Instance::make_callee() const {
  Callee callee{.name = setup_.name, .use = setup_.use, .place = setup_.place};
  callee.runs_alone = (description().capabilities & Capability::runs_alone) != 0;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(entry_.create), &info) != 0 && info.dli_fname)
    callee.library = info.dli_fname;
  const bool whole_scene = setup_.items.size() == 1 && !setup_.items[0].robot && setup_.items[0].object == world_object;
  for (std::size_t i = 0; i < setup_.items.size() && !whole_scene; ++i) {
    const Item& item = setup_.items[i];
    Callee::OfItem& of_item = callee.items.emplace_back();
    const RobotId robot = item.robot ? item.robot->id : world_.robot_of(item.object);
    of_item.is_robot = robot != no_robot;
    of_item.object = of_item.is_robot ? world_.robots()[index_of(robot)]->name : world_.object_name(item.object);
    if (setup_.item_setups.empty()) continue;
    of_item.name = setup_.item_setups[i].name;
    of_item.place = setup_.item_setups[i].place;
  }
  return std::make_shared<const Callee>(std::move(callee));
}

/// Messages of the set-up name the robot when there are several and the algorithm has noted one.
void Instance::require(bool fine, const abi::ErrorText& error, const char* doing) const {
  if (fine) return;
  if (error.view() == std::bad_alloc().what()) throw std::bad_alloc();  // a lack of memory is the scene's matter
  const RunningCall& call = running_call();
  const bool noted = callee_->items.size() > 1 && call.note.item.load() < callee_->items.size();
  const std::string about =
      noted ? who(call, error.view()) : fmt::format("{}{} ({})", prefix_of(setup_.place), setup_.name, setup_.use);
  throw SetupError(fmt::format("{} {}: {}", about, doing, error.view()));
}

void Instance::connect() {
  const CallScope scope(*callee_, "connect");
  abi::ErrorText error;
  require(algorithm_->connect(*this, error), error, "cannot be connected");
}

void Instance::connect_by_name() {
  const CallScope scope(*callee_, "connect_by_name");
  abi::ErrorText error;
  require(algorithm_->connect_by_name(*this, error), error, "cannot be connected");
}

void Instance::start() {
  if (is_left_out_) return;
  const CallScope scope(*callee_, "start");
  abi::ErrorText error;
  require(algorithm_->start(error), error, "cannot start");
}

void Instance::restored() {
  if (is_left_out_) return;
  const CallScope scope(*callee_, "restored");
  abi::ErrorText error;
  require(algorithm_->restored(error), error, "cannot go on from the restored state");
}

void Instance::finish() {
  if (is_left_out_) return;
  const CallScope scope(*callee_, "finish");
  abi::ErrorText error;
  require(algorithm_->finish(error), error, "cannot finish");
}

void Instance::leave_out() {
  is_left_out_ = true;
  bound_.clear();
  setup_.rate = Rate();  // on demand: it never runs, as nothing reads what it writes
}

bool Instance::on_handover(std::uint32_t item, abi::ErrorText& error) {
  if (is_left_out_) return true;
  const CallScope scope(*callee_, "on_handover", running_call().time.load());
  running_call().note.set_item(item);
  abi::ErrorText reason;
  if (algorithm_->on_handover(item, reason)) return true;
  error.set(fmt::format("{} cannot take the robot over: {}", who(running_call(), reason.view()), reason.view()));
  return false;
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

std::vector<Task::Access> Instance::accesses() const {
  std::vector<Task::Access> all;
  for (const Bound& b : bound_) {
    if (world_.store().slot(b.slot).kind == Slot::Class::constant) continue;
    const bool shared = b.usage.access == Access::read || b.usage.access == Access::accumulate;
    all.push_back({b.slot, !shared});
  }
  Task::merge(all);
  return all;
}

std::vector<Phase> Instance::phases() const {
  const Rows<Phase> given = algorithm_->phases();
  std::vector<Phase> phases;
  for (std::size_t i = 0; i < given.size(); ++i) phases.push_back(given.known(i));
  if (!phases.empty()) return phases;
  const bool batched = (description().capabilities & Capability::batched) != 0;
  return {{batched ? Phase::IndexSpace::items : Phase::IndexSpace::whole, Phase::Scope::reads_all}};
}

std::uint64_t Instance::random_key(std::uint32_t i) const noexcept {
  return fnv1a(setup_.subsystem, fnv1a(world_.object_name(setup_.items[i].object)));
}

std::string_view Instance::resolve_path(std::string_view path) const noexcept {
  namespace fs = std::filesystem;
  std::error_code deleted;  // the working directory may not exist any more; the path then stays as it is
  const fs::path given(path), base = fs::absolute(setup_.folder.empty() ? "." : setup_.folder, deleted);
  return paths_.emplace_back((given.is_absolute() ? given : base / given).lexically_normal().string());
}

Rows<FoundProperty> Instance::properties(ObjectId object) const noexcept {
  found_.clear();
  for (const PropertyStore::NamedSlot& n : world_.store().properties(object)) {
    const Slot& s = world_.store().slot(n.slot);
    const KeyInfo* key = &world_.store().key_of(s);
    const bool is_sum = std::any_of(s.users.begin(), s.users.end(), [](const Slot::User& u) {
      return u.usage.access == Access::accumulate || u.usage.access == Access::read_sum;
    });
    if (!s.place && !s.array && !is_sum) continue;  // properties that have only been shared so far
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
  const std::size_t robot = index_of(world_.robot_of(object));
  const bool inactive = robot < inactive_at_start_.size() && inactive_at_start_[robot];
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
