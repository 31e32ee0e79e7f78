// SPDX-License-Identifier: MIT
#include "core/schedule/stage.hpp"

#include <algorithm>

namespace muro {

void Task::merge(std::vector<Access>& accesses) {
  std::sort(accesses.begin(), accesses.end(), [](const Access& a, const Access& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.exclusive > b.exclusive;
  });
  const auto same = [](const Access& a, const Access& b) { return a.slot == b.slot; };
  accesses.erase(std::unique(accesses.begin(), accesses.end(), same), accesses.end());
}

std::vector<std::uint32_t> block_bounds(std::uint32_t count) {
  constexpr std::uint32_t lane = 8, max_block = 64, usual_block = 24;
  // An even number of blocks, so that two threads get the same; enough of them for the threads of a large machine.
  const std::uint32_t wanted = std::clamp((count + usual_block) / (2 * usual_block), 1u, 8u);
  const std::uint32_t needed = (count + 2 * max_block - 1) / (2 * max_block);
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

constexpr std::int32_t no_chain = -1, several_chains = -2;

/// The stage that is being built, with the accesses of its chains.
class StageBuilder {
 public:
  explicit StageBuilder(std::size_t slots) : users_(slots) {}

  /// The chain that a call with these accesses must follow: no_chain, a chain, or several_chains.
  std::int32_t chain_before(std::span<const Task::Access> accesses) const {
    std::int32_t found = no_chain;
    for (const Task::Access& a : accesses) {
      const Users& u = users_[a.slot];
      if (u.stage != stage_) continue;
      found = both(found, u.writer);
      if (a.exclusive) found = both(found, u.reader);
      if (found == several_chains) break;
    }
    return found;
  }
  void add(std::int32_t chain, const Stage::Call& call, std::span<const Task::Access> accesses) {
    const auto c = std::size_t(chain == no_chain ? std::int32_t(chains_.size()) : chain);
    if (c == chains_.size()) chains_.emplace_back();
    chains_[c].push_back(call);
    for (const Task::Access& a : accesses) user_of(a) = both(user_of(a), std::int32_t(c));
  }
  /// Accesses that the calls of several chains have in common.
  void add_common(std::span<const Task::Access> accesses) {
    for (const Task::Access& a : accesses) user_of(a) = several_chains;
  }
  void close(std::vector<Stage>& stages) {
    ++stage_;
    if (chains_.empty()) return;
    Stage s;
    for (const auto& chain : chains_) {
      s.calls.insert(s.calls.end(), chain.begin(), chain.end());
      s.ends.push_back(std::uint32_t(s.calls.size()));
    }
    s.all_optional =
        std::all_of(s.calls.begin(), s.calls.end(), [](const Stage::Call& c) { return c.enabled != nullptr; });
    stages.push_back(std::move(s));
    chains_.clear();
  }

 private:
  struct Users {
    std::uint32_t stage = 0;
    std::int32_t writer = no_chain, reader = no_chain;
  };
  std::int32_t& user_of(const Task::Access& a) {
    Users& u = users_[a.slot];
    if (u.stage != stage_) u = {stage_, no_chain, no_chain};
    return a.exclusive ? u.writer : u.reader;
  }
  static std::int32_t both(std::int32_t a, std::int32_t b) {
    return a == no_chain ? b : b == no_chain || a == b ? a : several_chains;
  }

  std::vector<Users> users_;
  std::vector<std::vector<Stage::Call>> chains_;
  std::uint32_t stage_ = 1;
};

/// A call with its own accesses; those that all calls of its phase have in common are kept once.
struct CallWithAccesses {
  Stage::Call call;
  std::vector<Task::Access> accesses;
};
using Calls = std::vector<CallWithAccesses>;

/// Divides the phases of one task into calls, by blocks of robots.
class TaskPartition {
 public:
  TaskPartition(const Task& task, std::span<const RobotId> robot_of_slot, const std::vector<std::uint32_t>& bounds)
      : task_(task), bounds_(bounds), of_block_(bounds.size()) {
    for (const Task::Access& a : task.accesses) {
      const RobotId robot = robot_of_slot[a.slot];
      (robot == no_robot ? of_no_robot_ : of_block_[block_of(index_of(robot))]).push_back(a);
    }
    in_order_ = task.robot_of_item.size() == task.items &&
                std::is_sorted(task.robot_of_item.begin(), task.robot_of_item.end()) &&
                (task.items == 0 || task.robot_of_item.back() != no_robot);
  }

  /// The calls of a phase. `common`: the accesses that all of them have, without harm to each other.
  Calls calls(Stage::Call call, std::vector<Task::Access>& common) const {
    const Phase phase = task_.phases[call.phase];
    const std::uint32_t length = task_.length(call.phase);
    const bool over_robots = phase.index_space == Phase::IndexSpace::robots;
    common.clear();
    if (phase.index_space == Phase::IndexSpace::whole || length == 0 || (!over_robots && !in_order_)) {
      call.range = {0, length};
      return {{call, task_.accesses}};
    }
    common = of_no_robot_;
    if (phase.scope == Phase::Scope::reads_all)
      for (const auto& block : of_block_)
        for (const Task::Access& a : block)
          if (!a.exclusive) common.push_back(a);
    Calls calls;
    for (std::size_t b = 0; b + 1 < bounds_.size(); ++b) {
      call.range = over_robots ? Range{bounds_[b], bounds_[b + 1]} : items_of(bounds_[b], bounds_[b + 1]);
      if (call.range.begin == call.range.end) continue;
      CallWithAccesses& of_block = calls.emplace_back(CallWithAccesses{call, {}});
      for (const Task::Access& a : of_block_[b])
        if (a.exclusive || phase.scope == Phase::Scope::own_robot) of_block.accesses.push_back(a);
    }
    if (phase.fine_grained) calls = one_by_one(calls);
    if (calls.size() == 1) {
      calls[0].accesses.insert(calls[0].accesses.end(), common.begin(), common.end());
      common.clear();
    }
    return calls;
  }

 private:
  /// A call for each element. Each of them has, for all we know, the accesses of the whole block; a fine-grained phase
  /// guarantees that they do not harm each other.
  static Calls one_by_one(const Calls& blocks) {
    Calls calls;
    for (const CallWithAccesses& block : blocks)
      for (std::uint32_t i = block.call.range.begin; i < block.call.range.end; ++i) {
        calls.push_back(block);
        calls.back().call.range = {i, i + 1};
      }
    return calls;
  }
  std::size_t block_of(std::uint32_t robot) const {
    return std::size_t(std::upper_bound(bounds_.begin(), bounds_.end(), robot) - bounds_.begin()) - 1;
  }
  Range items_of(std::uint32_t first, std::uint32_t end) const {
    const auto& robots = task_.robot_of_item;
    const auto at = [&](std::uint32_t robot) {
      return std::uint32_t(std::lower_bound(robots.begin(), robots.end(), RobotId{robot}) - robots.begin());
    };
    return {at(first), at(end)};
  }

  const Task& task_;
  const std::vector<std::uint32_t>& bounds_;
  std::vector<std::vector<Task::Access>> of_block_;
  std::vector<Task::Access> of_no_robot_;
  bool in_order_ = false;  ///< items stand in the order of their robots
};

}  // namespace

std::vector<Stage> stages_of(std::span<const Task::Due> due, std::span<const Task> tasks,
                             std::span<const RobotId> robot_of_slot, bool overlap) {
  std::uint32_t robots = 0;
  for (const Task& t : tasks) robots = std::max(robots, t.robots);
  const std::vector<std::uint32_t> bounds = block_bounds(robots);
  std::vector<Stage> stages;
  StageBuilder builder(robot_of_slot.size());
  std::vector<Task::Access> common;
  std::vector<std::int32_t> chains;
  for (std::uint32_t order = 0; order < due.size(); ++order) {
    const TaskId id = due[order].task;
    const Task& task = tasks[id];
    const TaskPartition partition(task, robot_of_slot, bounds);
    for (std::uint32_t number = 0; number < task.phases.size(); ++number) {
      const Phase& phase = task.phases[number];
      const Calls calls = partition.calls({.task = id,
                                           .phase = number,
                                           .range = {},
                                           .dt = due[order].dt,
                                           .instant = due[order].instant,
                                           .order = order,
                                           .enabled = phase.enabled},
                                          common);
      chains.clear();
      bool joins = builder.chain_before(common) == no_chain;
      for (const CallWithAccesses& c : calls) {
        const std::int32_t chain = joins ? builder.chain_before(c.accesses) : no_chain;
        const bool taken = chain != no_chain && std::find(chains.begin(), chains.end(), chain) != chains.end();
        joins = joins && chain != several_chains && !taken;
        chains.push_back(chain);
      }
      // The next phase may read what a phase has found of any robot, if its scope allows it.
      joins = joins && overlap && (number == 0 || phase.scope == Phase::Scope::own_robot) && !task.runs_alone;
      if (!joins) builder.close(stages);
      for (std::size_t k = 0; k < calls.size(); ++k)
        builder.add(joins ? chains[k] : no_chain, calls[k].call, calls[k].accesses);
      builder.add_common(common);
      if (task.runs_alone) builder.close(stages);
    }
  }
  builder.close(stages);
  return stages;
}

}  // namespace muro
