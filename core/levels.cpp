// SPDX-License-Identifier: MIT
#include "core/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// Steps only those items of an instance whose robots it moves at present.
class Levels::LevelFilter final : public abi::AlgorithmInstance {
 public:
  explicit LevelFilter(abi::AlgorithmInstance& filtered, std::vector<Phase> phases)
      : filtered_(filtered), phases_(std::move(phases)) {}
  void add(const std::uint32_t* level, std::uint32_t own) { items_.push_back({level, own}); }

  bool connect(Connector& c, abi::ErrorText& e) noexcept override { return filtered_.connect(c, e); }
  bool connect_by_name(Connector& c, abi::ErrorText& e) noexcept override { return filtered_.connect_by_name(c, e); }
  bool start(abi::ErrorText& e) noexcept override { return filtered_.start(e); }
  Rows<Phase> phases() const noexcept override { return filtered_.phases(); }
  bool restored(abi::ErrorText& e) noexcept override { return filtered_.restored(e); }
  bool finish(abi::ErrorText& e) noexcept override { return filtered_.finish(e); }
  void destroy() noexcept override {}
  bool on_handover(std::uint32_t item, abi::ErrorText& e) noexcept override { return filtered_.on_handover(item, e); }
  void* find_extension(const ExtensionId& id) noexcept override { return filtered_.find_extension(id); }

  bool step(const Step& step, Range range, abi::ErrorText& error) noexcept override {
    if (phases_[step.phase].index_space != Phase::IndexSpace::items)
      return std::none_of(items_.begin(), items_.end(), [](const FilteredItem& k) { return k.moves(); }) ||
             filtered_.step(step, range, error);
    for (std::uint32_t begin = range.begin, end = begin; begin < range.end; begin = end) {
      while (begin < range.end && !items_[begin].moves()) ++begin;
      for (end = begin; end < range.end && items_[end].moves();) ++end;
      if (begin < end && !filtered_.step(step, {begin, end}, error)) return false;
    }
    return true;
  }

 private:
  struct FilteredItem {
    const std::uint32_t* level;  ///< null: no other motion moves it
    std::uint32_t own;
    bool moves() const { return !level || *level == own; }
  };
  abi::AlgorithmInstance& filtered_;
  std::vector<Phase> phases_;
  std::vector<FilteredItem> items_;
};

Levels::Levels() = default;
Levels::~Levels() = default;

void Levels::prepare(World& world, const std::vector<LevelsOfRobot>& robots,
                     std::span<const std::unique_ptr<Instance>> all) {
  if (robots.empty()) return;
  const Accessor accessor = world.store().add_accessor("the hand-over between motions");
  for (const LevelsOfRobot& setup : robots) {
    Robot& r = robots_.emplace_back();
    r.view = setup.robot;
    r.first = setup.first;
    r.movers = movers_of(setup, all);
    std::vector<Accessor> accessors{accessor};
    for (const Mover& m : r.movers) accessors.push_back(m.instance->accessor());
    std::vector<ObjectId> objects;
    for (std::uint32_t i = 0; i < world.object_count(); ++i)
      if (world.robot_of(ObjectId{i}) == setup.robot->id) objects.push_back(ObjectId{i});
    world.store().let_alternate(objects, accessors);
    add_properties(world, accessor, setup.names, r);
  }
}

/// The motions of a robot, by level.
std::vector<Levels::Mover> Levels::movers_of(const LevelsOfRobot& setup,
                                             std::span<const std::unique_ptr<Instance>> all) {
  std::vector<Mover> movers(setup.names.size());
  for (const auto& instance : all) {
    if (instance->description().kind != Kind::motion) continue;
    const std::vector<Item>& items = instance->setup().items;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      if (items[i].robot != setup.robot) continue;
      Mover& mover = movers.at(items[i].level);
      if (mover.instance)
        throw SetupError(fmt::format("`{}` is moved by {} and by {}; list all of its motions under `levels` of one",
                                     setup.robot->name, mover.instance->setup().name, instance->setup().name));
      mover = {instance.get(), i, {}};
    }
  }
  for (const Mover& m : movers)
    if (!m.instance)
      throw SetupError(
          fmt::format("`{}` lists {} motions, but not all of them are used", setup.robot->name, setup.names.size()));
  return movers;
}

void Levels::add_properties(World& world, Accessor accessor, const std::vector<std::string>& names, Robot& r) {
  PropertyStore& store = world.store();
  const ObjectId base = r.view->base();
  const auto bind = [&](const KeyInfo& key, Usage usage, const void* initial) {
    return store.bind(accessor, base, key, usage, Multiplicity::single, 1, initial);
  };
  const std::int32_t no_target = -1;
  r.level = static_cast<std::uint32_t*>(bind(keys::motion_level, usage::variable, &r.first));
  r.level_slot = store.slots_of(accessor).back();
  r.target = static_cast<const std::int32_t*>(bind(keys::motion_level_target, usage::input, &no_target));
  r.target_slot = store.slots_of(accessor).back();
  r.rule = static_cast<const std::int32_t*>(bind(keys::motion_level_rule, usage::input, &no_target));
  r.rule_slot = store.slots_of(accessor).back();
  std::vector<TextId> texts;
  for (const std::string& name : names) texts.push_back(world.intern(name));
  world.set_array(base, keys::motion_level_names, std::span<const TextId>(texts));
}

Levels::Robot* Levels::find(RobotId id) {
  const auto r = std::find_if(robots_.begin(), robots_.end(), [&](const Robot& k) { return k.view->id == id; });
  return r == robots_.end() ? nullptr : &*r;
}
const Levels::Robot* Levels::find(RobotId id) const { return const_cast<Levels*>(this)->find(id); }

bool Levels::is_inactive_at_start(RobotId robot, std::uint32_t level) const {
  const Robot* r = find(robot);
  return r && r->first != level;
}

/// Returns the motion traits that the motion writes, each once, in rising order.
std::vector<SlotId> Levels::traits_of(const World& world, const Robot& robot, const Mover& mover) const {
  std::vector<SlotId> traits;
  for (const SlotId slot : mover.instance->writes()) {
    const Slot& s = store_->slot(slot);
    if (store_->key_of(s).role == Role::motion_trait && world.robot_of(s.object) == robot.view->id)
      traits.push_back(slot);
  }
  std::sort(traits.begin(), traits.end());
  traits.erase(std::unique(traits.begin(), traits.end()), traits.end());
  return traits;
}

void Levels::complete(World& world) {
  store_ = &world.store();
  for (Robot& r : robots_) {
    std::vector<std::vector<SlotId>> written;
    for (const Mover& m : r.movers) {
      m.instance->add_read(r.level_slot);
      written.push_back(traits_of(world, r, m));
      std::vector<SlotId> all;
      std::set_union(r.traits.begin(), r.traits.end(), written.back().begin(), written.back().end(),
                     std::back_inserter(all));
      r.traits = std::move(all);
    }
    for (std::size_t level = 0; level < r.movers.size(); ++level)
      std::set_difference(r.traits.begin(), r.traits.end(), written[level].begin(), written[level].end(),
                          std::back_inserter(r.movers[level].lacks));
    for (const SlotId slot : r.movers[r.first].lacks) store_->clear(slot);
  }
}

abi::AlgorithmInstance* Levels::filter_of(Instance& instance) {
  const std::vector<Item>& items = instance.setup().items;
  const bool alternates =
      instance.description().kind == Kind::motion && (instance.description().capabilities & Capability::world) == 0 &&
      std::any_of(items.begin(), items.end(), [&](const Item& i) { return i.robot && find(i.robot->id); });
  if (!alternates) return &instance.algorithm();
  LevelFilter& filter = *filters_.emplace_back(std::make_unique<LevelFilter>(instance.algorithm(), instance.phases()));
  for (const Item& i : items) {
    const Robot* r = find(i.robot->id);
    filter.add(r ? r->level : nullptr, i.level);
  }
  return &filter;
}

std::vector<SlotId> Levels::written() const {
  std::vector<SlotId> slots;
  for (const Robot& r : robots_) {
    slots.push_back(r.level_slot);
    slots.insert(slots.end(), r.traits.begin(), r.traits.end());
  }
  return slots;
}

Task Levels::task(std::span<const std::unique_ptr<Instance>> all) {
  Task t;
  t.name = "levels";
  t.instance = this;
  t.items = 1;
  t.kind = Kind::level;
  t.rank = Task::Rank::second;  // after the rules
  t.writes = written();
  for (const SlotId slot : t.writes) t.accesses.push_back({slot, true});
  for (const Robot& r : robots_) {
    for (const SlotId slot : {r.target_slot, r.rule_slot}) {
      t.reads.push_back(slot);
      t.accesses.push_back({slot, false});
    }
  }
  // A motion that takes over may write whatever it writes in a step.
  for (const auto& instance : all) {
    const bool involved = std::any_of(robots_.begin(), robots_.end(), [&](const Robot& r) {
      return std::any_of(r.movers.begin(), r.movers.end(),
                         [&](const Mover& m) { return m.instance == instance.get(); });
    });
    if (!involved) continue;
    for (Task::Access access : instance->accesses()) {
      access.exclusive = true;
      t.accesses.push_back(access);
    }
  }
  Task::merge(t.accesses);
  return t;
}

bool Levels::step(const Step&, Range, abi::ErrorText& error) noexcept {
  for (Robot& r : robots_) {
    const std::int32_t target = *r.rule >= 0 ? *r.rule : *r.target;
    if (target < 0 || std::uint32_t(target) == *r.level) continue;
    if (std::size_t(target) >= r.movers.size()) {
      error.set(fmt::format("`motion.level.target` of `{}` is {}, but it has {} motions, from 0", r.view->name, target,
                            r.movers.size()));
      return false;
    }
    *r.level = std::uint32_t(target);
    const Mover& m = r.movers[std::size_t(target)];
    for (const SlotId slot : m.lacks) store_->clear(slot);
    if (!m.instance->on_handover(m.item, error)) return false;
  }
  return true;
}

}  // namespace muro
