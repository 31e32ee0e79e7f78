// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro {

/// One run of an algorithm, or of one of its phases. May grow at its end.
struct Step {
  std::int64_t time = 0;    ///< ns of simulated time since the start
  double dt = 0;            ///< s, period of the algorithm; on demand: period of its reader
  std::uint64_t index = 0;  ///< number of runs of the algorithm before this one
  std::uint64_t seed = 0;   ///< seed of the simulation
  std::uint32_t phase = 0;  ///< index of the phase in Algorithm::phases()

  double seconds() const { return 1e-9 * double(time); }
};

/// Elements `begin` to `end` - 1 of the index space of a phase: one call of `step` serves them.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A part of a step, and how it may be divided among threads.
///
/// The phases of a step run one after the other. A phase that reads all begins when the phase before it has served all
/// elements, so it may read the results of that phase. The range of a divided phase is cut into blocks, which do not
/// depend on the number of threads; `step` is called for the blocks in any order, several at the same time. Each block
/// writes only what belongs to its own elements. Memory that a call uses for itself is local to the call or
/// thread_local. May grow at its end.
struct Phase {
  enum class IndexSpace : std::uint8_t {
    whole,   ///< one call, with all items
    items,   ///< the items of the instance
    robots,  ///< all robots of the scene, by RobotId: for algorithms that serve the whole scene
  };
  enum class Scope : std::uint8_t {
    /// reads and writes properties of its element's robot alone, and reads those that belong to no robot
    own_robot,
    reads_all,  ///< writes properties of its element's robot, reads anything that the algorithm has declared
  };
  IndexSpace index_space = IndexSpace::whole;
  Scope scope = Scope::reads_all;
  bool fine_grained = false;  ///< an element takes more than some microseconds: each has a call of its own
  /// Null, or a number that an earlier phase of the step writes: 0 leaves this phase out.
  const std::uint8_t* enabled = nullptr;
};

}  // namespace muro
