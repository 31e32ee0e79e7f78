// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro {

/// One run of an algorithm, or of one of its phases.
struct Step {
  std::int64_t time = 0;    ///< ns of simulated time since the start
  double dt = 0;            ///< s, the period of the algorithm; on demand: the period of the reader that asks
  std::uint64_t index = 0;  ///< how often the algorithm ran before
  std::uint64_t seed = 0;   ///< of the simulation
  std::uint32_t phase = 0;  ///< of the step: place in Algorithm::phases()

  double seconds() const { return 1e-9 * double(time); }
};

/// Elements `begin` to `end` - 1 of what a phase works on: those that one call of `step` is to serve.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A part of a step, and how it may be divided among threads.
///
/// The phases of a step run one behind the other; one that reads all begins when the phase before it is through with
/// all elements, so it may read what that has found. The range of a divided phase is cut into blocks that do not depend
/// on the number of threads; `step` is called for the blocks in any order, several at once. Each block writes only what
/// belongs to its own elements. Memory that a call uses for itself is local to the call or thread_local.
struct Phase {
  enum class IndexSpace : std::uint8_t {
    whole,   ///< one call, with all items
    items,   ///< the items of the instance
    robots,  ///< all robots of the scene, by robot number: for algorithms that serve the whole scene
  };
  enum class Scope : std::uint8_t {
    /// reads and writes properties of its element's robot alone, and reads those that belong to no robot
    own_robot,
    reads_all,  ///< writes properties of its element's robot, reads anything that the algorithm has declared
  };
  IndexSpace index_space = IndexSpace::whole;
  Scope scope = Scope::reads_all;
  bool fine_grained = false;  ///< an element takes more than some microseconds: each has a call of its own
  /// Null, or where an earlier phase of the step writes whether this one is to run. It is left out when that is 0.
  const std::uint8_t* enabled = nullptr;
};

}  // namespace muro
