// SPDX-License-Identifier: MIT
#include "core/levels.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// Steps those items of an instance whose robots it moves at present.
class Levels::LevelFilter final : public abi::AlgorithmInstance {
 public:
  explicit LevelFilter(abi::AlgorithmInstance& filtered, std::vector<Phase> phases)
      : filtered_(filtered), phases_(std::move(phases)) {}
  void add(const std::uint32_t* level, std::uint32_t own) { items_.push_back({level, own}); }

  bool connect(Connector& c, abi::ErrorText& e) noexcept override { return filtered_.connect(c, e); }
  bool connect_by_name(Connector& c, abi::ErrorText& e) noexcept override { return filtered_.connect_by_name(c, e); }
  bool start(abi::ErrorText& e) noexcept override { return filtered_.start(e); }
  std::span<const Phase> phases() const noexcept override { return filtered_.phases(); }
  bool restored(abi::ErrorText& e) noexcept override { return filtered_.restored(e); }
  bool finish(abi::ErrorText& e) noexcept override { return filtered_.finish(e); }
  void destroy() noexcept override {}
  bool on_handover(std::uint32_t item, abi::ErrorText& e) noexcept override { return filtered_.on_handover(item, e); }

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
  PropertyStore& store = world.store();
  const Accessor accessor = store.add_accessor("the hand-over between motions");
  for (const LevelsOfRobot& setup : robots) {
    Robot& r = robots_.emplace_back();
    r.view = setup.robot;
    r.first = setup.first;
    r.movers.resize(setup.names.size());
    for (const auto& instance : all) {
      const std::vector<Item>& items = instance->setup().items;
      for (std::uint32_t i = 0; i < items.size(); ++i)
        if (instance->description().kind == Kind::motion && items[i].robot == setup.robot) {
          Mover& mover = r.movers.at(items[i].level);
          if (mover.instance)
            throw SetupError("`" + std::string(setup.robot->name) + "` is moved by " + mover.instance->setup().name +
                             " and by " + instance->setup().name + "; list all of its motions under `levels` of one");
          mover = {instance.get(), i};
        }
    }
    std::vector<Accessor> accessors{accessor};
    for (const Mover& m : r.movers) {
      if (!m.instance)
        throw SetupError("`" + std::string(setup.robot->name) + "` lists " + std::to_string(setup.names.size()) +
                         " motions, but not all of them are used");
      accessors.push_back(m.instance->accessor());
    }
    std::vector<ObjectId> objects;
    for (std::uint32_t i = 0; i < world.object_count(); ++i)
      if (world.robot_of(ObjectId{i}) == std::int32_t(setup.robot->number)) objects.push_back(ObjectId{i});
    store.let_alternate(objects, accessors);

    const ObjectId base = setup.robot->base();
    const auto own = [&](const KeyInfo& key, Usage usage, const void* initial) {
      void* place = store.bind(accessor, base, key, usage, Multiplicity::single, 1, initial);
      if (usage == usage::variable) r.written.push_back(store.slots_of(accessor).back());
      return place;
    };
    const std::int32_t nobody = -1;
    const std::uint64_t unmoved = 0;
    const double no_lag = 0;
    r.level = static_cast<std::uint32_t*>(own(keys::motion_level, usage::variable, &setup.first));
    r.level_slot = store.slots_of(accessor).back();
    r.target = static_cast<const std::int32_t*>(own(keys::motion_level_target, usage::input, &nobody));
    r.target_slot = store.slots_of(accessor).back();
    r.contact_world = static_cast<std::uint64_t*>(own(keys::contact_world, usage::variable, &unmoved));
    r.twist_lag = static_cast<double*>(own(keys::twist_lag, usage::variable, &no_lag));
    std::vector<TextId> names;
    for (const std::string& name : setup.names) names.push_back(world.intern(name));
    world.set_array(base, keys::motion_level_names, std::span<const TextId>(names));
  }
}

Levels::Robot* Levels::find(std::int32_t number) {
  const auto r = std::find_if(robots_.begin(), robots_.end(),
                              [&](const Robot& k) { return std::int32_t(k.view->number) == number; });
  return r == robots_.end() ? nullptr : &*r;
}
const Levels::Robot* Levels::find(std::int32_t number) const { return const_cast<Levels*>(this)->find(number); }

bool Levels::rests(std::int32_t number, std::uint32_t level) const {
  const Robot* r = find(number);
  return r && r->first != level;
}

void Levels::complete() {
  for (Robot& r : robots_)
    for (const Mover& m : r.movers) m.instance->also_reads(r.level_slot);
}

abi::AlgorithmInstance* Levels::filter_of(Instance& instance) {
  const std::vector<Item>& items = instance.setup().items;
  const bool part_time = instance.description().kind == Kind::motion &&
                         (instance.description().capabilities & Capability::world) == 0 &&
                         std::any_of(items.begin(), items.end(),
                                     [&](const Item& i) { return i.robot && find(std::int32_t(i.robot->number)); });
  if (!part_time) return &instance.algorithm();
  LevelFilter& keeper = *filters_.emplace_back(std::make_unique<LevelFilter>(instance.algorithm(), instance.phases()));
  for (const Item& i : items) {
    const Robot* r = find(std::int32_t(i.robot->number));
    keeper.add(r ? r->level : nullptr, i.level);
  }
  return &keeper;
}

void Levels::forget_in(std::vector<SlotId>& reads) const {
  for (const Robot& r : robots_)
    std::erase_if(reads,
                  [&](SlotId slot) { return std::find(r.written.begin(), r.written.end(), slot) != r.written.end(); });
}

Task Levels::task(std::span<const std::unique_ptr<Instance>> all) {
  Task t;
  t.name = "levels";
  t.instance = this;
  t.items = 1;
  t.order = 2 * order_of(Kind::level) + 1;
  for (const Robot& r : robots_) {
    t.reads.push_back(r.target_slot);
    t.writes.insert(t.writes.end(), r.written.begin(), r.written.end());
  }
  // A motion that takes over may write whatever it writes in a step.
  for (const auto& instance : all) {
    const bool involved = std::any_of(robots_.begin(), robots_.end(), [&](const Robot& r) {
      return std::any_of(r.movers.begin(), r.movers.end(),
                         [&](const Mover& m) { return m.instance == instance.get(); });
    });
    if (!involved) continue;
    for (Touch touch : instance->touches()) {
      touch.exclusive = true;
      t.touches.push_back(touch);
    }
  }
  for (const Robot& r : robots_) {
    for (const SlotId slot : r.written) t.touches.push_back({slot, true});
    t.touches.push_back({r.target_slot, false});
  }
  std::sort(t.touches.begin(), t.touches.end(), [](const Touch& a, const Touch& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.exclusive > b.exclusive;
  });
  t.touches.erase(
      std::unique(t.touches.begin(), t.touches.end(), [](const Touch& a, const Touch& b) { return a.slot == b.slot; }),
      t.touches.end());
  return t;
}

bool Levels::step(const Step&, Range, abi::ErrorText& error) noexcept {
  for (Robot& r : robots_) {
    const std::int32_t target = *r.target;
    if (target < 0 || std::uint32_t(target) == *r.level) continue;
    if (std::size_t(target) >= r.movers.size()) {
      error.set("`motion.level.target` of `" + std::string(r.view->name) + "` is " + std::to_string(target) +
                ", but it has " + std::to_string(r.movers.size()) + " motions, from 0");
      return false;
    }
    *r.contact_world = 0;
    *r.twist_lag = 0;
    *r.level = std::uint32_t(target);
    const Mover& m = r.movers[std::size_t(target)];
    if (!m.instance->algorithm().on_handover(m.item, error)) return false;
  }
  return true;
}

}  // namespace muro
