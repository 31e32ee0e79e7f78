// SPDX-License-Identifier: MIT
#include "muro/base/random.hpp"

#include <gtest/gtest.h>

namespace muro {
namespace {

TEST(NormalNumbers, HaveTheBitsOfPairsDrawnOneByOne) {
  for (std::uint32_t count = 1; count < 200; ++count) {
    const Random random(1, count, 3);
    const std::uint32_t first = 7 * count;
    NormalNumbers numbers(random, count, first);
    for (std::uint32_t i = 0; i < count; ++i)
      ASSERT_EQ(numbers.next(), random.normal_pair(first + i / 2)[i % 2]) << i << " of " << count;
  }
}

}  // namespace
}  // namespace muro
