// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "each_isa.hpp"

namespace muro::lane_test {
namespace {

constexpr std::size_t length = 20;  ///< numbers of a place, with room on both sides

/// Eight places in a special order, whose numbers all differ.
struct Memory {
  std::vector<double> source, target;
  const double* from[8];
  double* to[8];

  Memory() {
    for (std::size_t i = 0; i < 8 * length; ++i) source.push_back(double(i) + 0.5);
    target.assign(8 * length, -1);
    for (std::size_t i = 0; i < 8; ++i) {
      from[i] = source.data() + length * (i * 5 % 8);
      to[i] = target.data() + length * (i * 3 % 8);
    }
  }
  /// Returns whether exactly the `n` numbers from `first` on, of the places in `which`, have been copied.
  testing::AssertionResult copied(int n, std::ptrdiff_t first, unsigned which) const {
    for (int i = 0; i < 8; ++i)
      for (std::ptrdiff_t k = 0; k < std::ptrdiff_t(length); ++k) {
        const bool meant = (which >> i & 1) != 0 && k >= first && k < first + n;
        if (to[i][k] != (meant ? from[i][k] : -1))
          return testing::AssertionFailure() << "number " << k << " of place " << i << " is " << to[i][k];
      }
    return testing::AssertionSuccess();
  }
};

TEST(Rows, AreReadAndWrittenWithNothingBesideThem) {
  for (const lane::Isa isa : each_isa())
    for (int n = 1; n <= 8; ++n)
      for (const Width width : {Width::four, Width::eight})
        for (unsigned which = 0; which < (width == Width::four ? 16u : 256u); ++which) {
          Memory memory;
          kernels_for(isa).copy_rows(width, n, memory.from, memory.to, 5, which);
          ASSERT_TRUE(memory.copied(n, 5, which)) << n << " numbers of the places " << which;
        }
}

TEST(Rows, VectorsPosesAndTwistsLieAsInProperties) {
  for (const lane::Isa isa : each_isa())
    for (const unsigned which : {255u, 254u, 15u, 1u, 0u}) {
      Memory memory;
      kernels_for(isa).copy_properties(memory.from, memory.to, which);
      ASSERT_TRUE(memory.copied(16, 0, which)) << which;
    }
}

}  // namespace
}  // namespace muro::lane_test
