// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/running_call.hpp"
#include "core/schedule/rate.hpp"
#include "muro/detail/abi.hpp"

namespace muro {

/// Access to a property, by its slot in the property store. Access that is not exclusive may overlap with its like.
struct SlotAccess {
  std::uint32_t slot = 0;
  bool exclusive = false;
};

/// Sorts by slot and leaves one access to each: an exclusive one where there is one.
inline void merge_accesses(std::vector<SlotAccess>& accesses) {
  std::sort(accesses.begin(), accesses.end(), [](const SlotAccess& a, const SlotAccess& b) {
    return a.slot != b.slot ? a.slot < b.slot : a.exclusive > b.exclusive;
  });
  const auto same = [](const SlotAccess& a, const SlotAccess& b) { return a.slot == b.slot; };
  accesses.erase(std::unique(accesses.begin(), accesses.end(), same), accesses.end());
}

/// The order of tasks of one kind.
enum class Rank : std::uint8_t { first, second };
constexpr int order_of(Kind kind, Rank rank) { return 2 * order_of(kind) + static_cast<int>(rank); }

/// What the scheduler runs: one instance of an algorithm with its items.
struct Task {
  std::string name;                      ///< "rovers.motion"
  std::shared_ptr<const Callee> callee;  ///< what messages say of it; null: the name alone
  abi::AlgorithmInstance* instance = nullptr;
  std::uint32_t items = 0;
  std::vector<RobotId> robot_of_item;        ///< empty: nobody asks
  std::vector<Phase> phases = {Phase{}};     ///< one or more
  std::uint32_t robots = 0;                  ///< of the scene
  bool runs_alone = false;                   ///< runs while nothing else does, on the calling thread
  Rate rate;                                 ///< on demand when zero
  std::int64_t phase = 0;                    ///< ns, 0 or more
  Kind kind = Kind::motion;                  ///< decides the order of tasks in an instant
  Rank rank = Rank::first;                   ///< within the kind
  std::vector<std::uint32_t> reads, writes;  ///< slots of the property store: who needs what on demand
  std::vector<SlotAccess> accesses;          ///< they decide what may run at the same time

  /// Tasks of one instant run by rising order, then in the order in which they were added.
  int order() const { return order_of(kind, rank); }
  /// The part of its kind in an instant.
  InstantPart part() const { return info_of(kind).part; }
  /// How many elements phase number `which` works on.
  std::uint32_t length(std::uint32_t which) const {
    return phases[which].index_space == Phase::IndexSpace::robots ? robots : items;
  }
};
using TaskId = std::uint32_t;

/// What a task has cost so far.
struct TaskCost {
  std::uint64_t runs = 0;
  std::uint64_t ticks = 0;  ///< of the cycle counter, over all threads; estimated once there are many runs
};

/// A task that is due in an instant.
struct DueTask {
  TaskId task = 0;
  double dt = 0;              ///< s
  std::uint32_t instant = 0;  ///< of several that are carried out together
};

}  // namespace muro
