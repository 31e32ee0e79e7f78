// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro {

/// One run of an algorithm.
struct Step {
  std::int64_t time = 0;    ///< ns of simulated time since the start
  double dt = 0;            ///< s, the period of the algorithm; on demand: the period of the reader that asks
  std::uint64_t index = 0;  ///< how often the algorithm ran before
  std::uint64_t seed = 0;   ///< of the simulation

  double seconds() const { return 1e-9 * double(time); }
};

/// Items `begin` to `end` - 1 of an instance: those that one call of `step` is to serve.
struct Range {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

}  // namespace muro
