// SPDX-License-Identifier: MIT
#include "core/schedule/stages.hpp"

#include <algorithm>

namespace muro {

std::vector<std::uint32_t> block_bounds(std::uint32_t count) {
  constexpr std::uint32_t lane = 8, largest = 64, share = 24;
  // An even number of blocks, so that two threads get the same; enough of them for the threads of a large machine.
  const std::uint32_t wanted = std::clamp((count + share) / (2 * share), 1u, 8u);
  const std::uint32_t needed = (count + 2 * largest - 1) / (2 * largest);
  const std::uint32_t blocks = count < 2 * lane ? 1 : 2 * std::max(wanted, needed);
  std::vector<std::uint32_t> bounds{0};
  for (std::uint32_t b = 1; b < blocks; ++b) {
    const auto at = std::uint32_t((std::uint64_t(b) * count + blocks / 2) / blocks);
    const std::uint32_t bound = (at + lane / 2) / lane * lane;
    if (bound > bounds.back() && bound < count) bounds.push_back(bound);
  }
  if (count > 0) bounds.push_back(count);
  return bounds;
}

namespace {

constexpr std::int32_t nobody = -1, several = -2;

/// The stage that is being filled, with what its chains touch.
class Filling {
 public:
  explicit Filling(std::size_t slots) : users_(slots) {}

  /// The chain that a toucher of these slots must follow: nobody, a chain, or several.
  std::int32_t before(std::span<const Touch> touches) const {
    std::int32_t found = nobody;
    for (const Touch& t : touches) {
      const Users& u = users_[t.slot];
      if (u.stage != stage_) continue;
      found = both(found, u.writer);
      if (t.exclusive) found = both(found, u.reader);
      if (found == several) break;
    }
    return found;
  }
  void add(std::int32_t chain, const Call& call, std::span<const Touch> touches) {
    const auto c = std::size_t(chain == nobody ? std::int32_t(chains_.size()) : chain);
    if (c == chains_.size()) chains_.emplace_back();
    chains_[c].push_back(call);
    for (const Touch& t : touches) role_of(t) = both(role_of(t), std::int32_t(c));
  }
  /// What the calls of several chains touch alike.
  void add_shared(std::span<const Touch> touches) {
    for (const Touch& t : touches) role_of(t) = several;
  }
  void close(std::vector<Stage>& stages) {
    ++stage_;
    if (chains_.empty()) return;
    Stage s;
    for (const auto& chain : chains_) {
      s.calls.insert(s.calls.end(), chain.begin(), chain.end());
      s.ends.push_back(std::uint32_t(s.calls.size()));
    }
    s.all_optional = std::all_of(s.calls.begin(), s.calls.end(), [](const Call& c) { return c.wanted != nullptr; });
    stages.push_back(std::move(s));
    chains_.clear();
  }

 private:
  struct Users {
    std::uint32_t stage = 0;
    std::int32_t writer = nobody, reader = nobody;
  };
  std::int32_t& role_of(const Touch& t) {
    Users& u = users_[t.slot];
    if (u.stage != stage_) u = {stage_, nobody, nobody};
    return t.exclusive ? u.writer : u.reader;
  }
  static std::int32_t both(std::int32_t a, std::int32_t b) {
    return a == nobody ? b : b == nobody || a == b ? a : several;
  }

  std::vector<Users> users_;
  std::vector<std::vector<Call>> chains_;
  std::uint32_t stage_ = 1;
};

/// A call with what it touches, as far as that is its own business; what all calls of its phase touch is kept once.
struct Part {
  Call call;
  std::vector<Touch> touches;
};

/// What one task touches, by the block of robots it belongs to.
class TaskCut {
 public:
  TaskCut(const Task& task, std::span<const std::int32_t> robot_of_slot, const std::vector<std::uint32_t>& bounds)
      : task_(task), bounds_(bounds), own_(bounds.size()) {
    for (const Touch& t : task.touches) {
      const std::int32_t robot = robot_of_slot[t.slot];
      (robot < 0 ? common_ : own_[block_of(std::uint32_t(robot))]).push_back(t);
    }
    in_order_ = task.robot_of_item.size() == task.items &&
                std::is_sorted(task.robot_of_item.begin(), task.robot_of_item.end()) &&
                (task.items == 0 || task.robot_of_item.front() >= 0);
  }

  /// The calls of a phase. `shared`: what all of them touch, without harm to each other.
  std::vector<Part> parts(Call call, std::vector<Touch>& shared) const {
    const Phase phase = task_.phases[call.phase];
    const std::uint32_t length = task_.length(call.phase);
    const bool over_robots = phase.index_space == Phase::IndexSpace::robots;
    shared.clear();
    if (phase.index_space == Phase::IndexSpace::whole || length == 0 || (!over_robots && !in_order_)) {
      call.range = {0, length};
      return {{call, task_.touches}};
    }
    shared = common_;
    if (phase.scope == Phase::Scope::reads_all)
      for (const auto& block : own_)
        for (const Touch& t : block)
          if (!t.exclusive) shared.push_back(t);
    std::vector<Part> parts;
    for (std::size_t b = 0; b + 1 < bounds_.size(); ++b) {
      call.range = over_robots ? Range{bounds_[b], bounds_[b + 1]} : items_of(bounds_[b], bounds_[b + 1]);
      if (call.range.begin == call.range.end) continue;
      Part part{call, {}};
      for (const Touch& t : own_[b])
        if (t.exclusive || phase.scope == Phase::Scope::own_robot) part.touches.push_back(t);
      parts.push_back(std::move(part));
    }
    if (phase.fine_grained) parts = one_by_one(parts);
    if (parts.size() == 1) {
      parts[0].touches.insert(parts[0].touches.end(), shared.begin(), shared.end());
      shared.clear();
    }
    return parts;
  }

 private:
  /// A call for each element. All of a block touch, for all we know, what the block touches; that they do not harm
  /// each other is the promise of the phase.
  static std::vector<Part> one_by_one(const std::vector<Part>& blocks) {
    std::vector<Part> parts;
    for (const Part& block : blocks)
      for (std::uint32_t i = block.call.range.begin; i < block.call.range.end; ++i) {
        parts.push_back(block);
        parts.back().call.range = {i, i + 1};
      }
    return parts;
  }
  std::size_t block_of(std::uint32_t robot) const {
    return std::size_t(std::upper_bound(bounds_.begin(), bounds_.end(), robot) - bounds_.begin()) - 1;
  }
  Range items_of(std::uint32_t first, std::uint32_t end) const {
    const auto& robots = task_.robot_of_item;
    const auto at = [&](std::uint32_t robot) {
      return std::uint32_t(std::lower_bound(robots.begin(), robots.end(), std::int32_t(robot)) - robots.begin());
    };
    return {at(first), at(end)};
  }

  const Task& task_;
  const std::vector<std::uint32_t>& bounds_;
  std::vector<std::vector<Touch>> own_;  ///< by block
  std::vector<Touch> common_;            ///< of no robot
  bool in_order_ = false;                ///< items stand in the order of their robots
};

}  // namespace

std::vector<Stage> stages_of(std::span<const Turn> turns, std::span<const Task> tasks,
                             std::span<const std::int32_t> robot_of_slot, bool overlap) {
  std::uint32_t robots = 0;
  for (const Task& t : tasks) robots = std::max(robots, t.robots);
  const std::vector<std::uint32_t> bounds = block_bounds(robots);
  std::vector<Stage> stages;
  Filling filling(robot_of_slot.size());
  std::vector<Touch> shared;
  std::vector<std::int32_t> chains;
  for (std::uint32_t turn = 0; turn < turns.size(); ++turn) {
    const TaskId id = turns[turn].task;
    const TaskCut cut(tasks[id], robot_of_slot, bounds);
    for (std::uint32_t phase = 0; phase < tasks[id].phases.size(); ++phase) {
      const std::vector<Part> parts = cut.parts({.task = id,
                                                 .phase = phase,
                                                 .range = {},
                                                 .dt = turns[turn].dt,
                                                 .instant = turns[turn].instant,
                                                 .turn = turn,
                                                 .wanted = tasks[id].phases[phase].enabled},
                                                shared);
      chains.clear();
      bool joins = filling.before(shared) == nobody;
      for (const Part& p : parts) {
        const std::int32_t chain = joins ? filling.before(p.touches) : nobody;
        const bool taken = chain != nobody && std::find(chains.begin(), chains.end(), chain) != chains.end();
        joins = joins && chain != several && !taken;
        chains.push_back(chain);
      }
      // What a phase has found of any robot, the next may read, if it reaches so far.
      const Phase& p = tasks[id].phases[phase];
      joins = joins && overlap && (phase == 0 || p.scope == Phase::Scope::own_robot) && !tasks[id].runs_alone;
      if (!joins) filling.close(stages);
      for (std::size_t k = 0; k < parts.size(); ++k)
        filling.add(joins ? chains[k] : nobody, parts[k].call, parts[k].touches);
      filling.add_shared(shared);
      if (tasks[id].runs_alone) filling.close(stages);
    }
  }
  filling.close(stages);
  return stages;
}

}  // namespace muro
