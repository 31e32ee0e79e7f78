// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/running_call.hpp"
#include "core/schedule/rate.hpp"
#include "muro/detail/abi.hpp"

namespace muro {

using TaskId = std::uint32_t;

/// A unit of work of the scheduler: one instance of an algorithm with its items.
struct Task {
  /// Access to a property, by its slot in the property store. Accesses that are not exclusive may overlap.
  struct Access {
    std::uint32_t slot = 0;
    bool exclusive = false;
  };
  /// Sorts accesses by slot and keeps one access to each slot: an exclusive one if there is one.
  static void merge(std::vector<Access>& accesses);

  /// Cost so far.
  struct Cost {
    std::uint64_t runs = 0;
    std::uint64_t ticks = 0;  ///< of the cycle counter, over all threads; estimated once there are many runs
  };

  /// A task that is due in an instant.
  struct Due {
    TaskId task = 0;
    double dt = 0;              ///< s
    std::uint32_t instant = 0;  ///< of several that are carried out together
  };

  /// The order of tasks of one kind.
  enum class Rank : std::uint8_t { first, second };
  static constexpr int order_of(Kind kind, Rank rank) { return 2 * muro::order_of(kind) + static_cast<int>(rank); }

  std::string name;                      ///< "rovers.motion"
  std::shared_ptr<const Callee> callee;  ///< for messages; null: the name alone
  abi::AlgorithmInstance* instance = nullptr;
  std::uint32_t items = 0;
  std::vector<RobotId> robot_of_item;        ///< empty: nobody asks
  std::vector<Phase> phases = {Phase{}};     ///< one or more
  std::uint32_t robots = 0;                  ///< of the scene
  bool runs_alone = false;                   ///< runs while nothing else runs, on the calling thread
  Rate rate;                                 ///< on demand when zero
  std::int64_t phase = 0;                    ///< ns, 0 or more
  Kind kind = Kind::motion;                  ///< decides the order of tasks in an instant
  Rank rank = Rank::first;                   ///< within the kind
  std::vector<std::uint32_t> reads, writes;  ///< slots of the property store: who needs what on demand
  std::vector<Access> accesses;              ///< they decide what may run at the same time

  /// The place in an instant: tasks run by rising order, then in the order in which they were added.
  int order() const { return order_of(kind, rank); }
  /// The part of its kind in an instant.
  InstantPart part() const { return info_of(kind).part; }
  /// Number of elements on which phase number `which` works.
  std::uint32_t length(std::uint32_t which) const {
    return phases[which].index_space == Phase::IndexSpace::robots ? robots : items;
  }
};

}  // namespace muro
