// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lane_kernels.hpp"

namespace muro::lane_test {

/// Returns the instruction sets that this processor can run.
inline std::vector<lane::Isa> each_isa() {
  std::vector<lane::Isa> all;
  for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512})
    if (isa <= lane::best_isa()) all.push_back(isa);
  return all;
}

}  // namespace muro::lane_test
