// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "core/schedule/task.hpp"

namespace muro {

/// Calls that may run at the same time, in call chains: the calls of a chain run one after the other. A chain is the
/// work item that a thread takes.
struct Stage {
  /// A call of an algorithm's step.
  struct Call {
    TaskId task = 0;
    std::uint32_t phase = 0;
    Range range;
    double dt = 0;                          ///< s
    std::uint32_t instant = 0;              ///< of several that are carried out together
    std::uint32_t order = 0;                ///< place of the due task in the order
    const std::uint8_t* enabled = nullptr;  ///< Phase::enabled
    bool is_enabled() const { return !enabled || *enabled != 0; }
  };

  std::vector<Call> calls;          ///< chain by chain
  std::vector<std::uint32_t> ends;  ///< end of each chain, in `calls`
  bool all_optional = false;        ///< each call has an `enabled`
  std::uint32_t chains() const { return std::uint32_t(ends.size()); }
  bool is_enabled() const {
    return !all_optional || std::any_of(calls.begin(), calls.end(), [](const Call& c) { return c.is_enabled(); });
  }
  std::span<const Call> chain(std::uint32_t c) const {
    const std::uint32_t first = c == 0 ? 0 : ends[c - 1];
    return std::span(calls).subspan(first, ends[c] - first);
  }
};

/// Divides the due tasks of an instant, or of several that follow each other, into stages, which run one after the
/// other.
///
/// The order of due tasks decides: two calls with access to one property, at least one of them exclusive, keep it,
/// by standing in one chain or in two stages. Everything else may overlap. Robots are divided into blocks of some tens;
/// a task that has access to its own robots only continues the chain of each block, so that a whole team is carried
/// through kinematics, contact and motion block by block, while its data is in the cache. The division depends on the
/// scene alone, never on the number of threads. scheduler.hpp shows an example.
/// `robot_of_slot`: the robot that a property belongs to. Without `overlap`, each phase of each due task
/// is a stage.
std::vector<Stage> stages_of(std::span<const Task::Due> due, std::span<const Task> tasks,
                             std::span<const RobotId> robot_of_slot, bool overlap = true);

/// Where blocks of `count` robots begin, and `count`: at multiples of 8, so that SIMD lanes are full.
std::vector<std::uint32_t> block_bounds(std::uint32_t count);

}  // namespace muro
