// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "each_isa.hpp"

namespace muro::lane_test {
namespace {

/// Random numbers, ordinary and special ones.
template <class T>
class Numbers {
 public:
  T next() {
    using Limits = std::numeric_limits<T>;
    constexpr T special[] = {T(0),
                             T(-0.0),
                             T(1),
                             T(-1),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::quiet_NaN(),
                             Limits::min(),
                             Limits::denorm_min(),
                             Limits::max(),
                             -Limits::denorm_min(),
                             Limits::epsilon()};
    const int which = std::uniform_int_distribution<int>(0, 2 * int(std::size(special)))(random_);
    if (which < int(std::size(special))) return special[which];
    return std::ldexp(std::uniform_real_distribution<T>(-1, 1)(random_),
                      std::uniform_int_distribution<int>(-10, 10)(random_));
  }
  void fill(T (&array)[values]) {
    for (T& x : array) x = next();
  }

 private:
  std::mt19937 random_{1};
};

/// Compares bit for bit, but accepts any NaN for a NaN, as IEEE 754 leaves it open.
bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
bool same(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Returns the result of the operation in plain C++.
template <class T>
T plain(Operation operation, T a, T b) {
  switch (operation) {
    case Operation::add:
    case Operation::add_to:
      return a + b;
    case Operation::subtract:
    case Operation::subtract_from:
      return a - b;
    case Operation::multiply:
    case Operation::multiply_by:
      return a * b;
    case Operation::divide:
      return a / b;
    case Operation::negate:
      return -a;
    case Operation::less:
    case Operation::minimum:
      return a < b ? a : b;
    case Operation::less_or_equal:
      return a <= b ? a : b;
    case Operation::greater:
    case Operation::maximum:
      return a > b ? a : b;
    case Operation::greater_or_equal:
      return a >= b ? a : b;
    case Operation::equal:
      return a == b ? a : b;
    case Operation::both:
      return a > b && a > 0 ? a : b;
    case Operation::either:
      return a > b || b > 0 ? a : b;
    case Operation::neither:
      return a > b || b > 0 ? b : a;
    case Operation::magnitude:
      return std::fabs(a);
    case Operation::root:
      return std::sqrt(a);
    case Operation::broadcast:
      break;
  }
  return a;
}

constexpr bool is_choice(int operation) {
  return operation >= int(Operation::less) && operation <= int(Operation::neither);
}

template <class T, class Apply>
void compare(Width width, int at_once, Apply apply) {
  Numbers<T> numbers;
  T a[values], b[values], out[values];
  for (int round = 0; round < 300; ++round)
    for (int operation = 0; operation < operations; ++operation) {
      numbers.fill(a);
      numbers.fill(b);
      unsigned bits = 0;
      apply(Operation(operation), width, a, b, out, &bits);
      for (int i = 0; i < values; ++i) {
        T expected = plain(Operation(operation), a[i], b[i]);
        if (Operation(operation) == Operation::broadcast) {
          bool any = false;
          for (int k = i / at_once * at_once; k < i / at_once * at_once + at_once; ++k) any = any || a[k] < b[k];
          expected = any ? T(-0.0) : T(1e-3);
        }
        ASSERT_TRUE(same(out[i], expected)) << "operation " << operation << " of " << a[i] << " and " << b[i] << " is "
                                            << out[i] << ", not " << expected << "; " << at_once << " at a time";
        if (is_choice(operation) && !same(a[i], b[i]) && sizeof(T) == 8) {
          ASSERT_EQ(bits >> i & 1, same(expected, a[i])) << "operation " << operation << ", value " << i;
        }
      }
    }
}

TEST(Lane, OperationsOfDoublesAreThoseOfOneDoubleOnAnyIsa) {
  for (const lane::Isa isa : each_isa()) {
    compare<double>(Width::one, 1, kernels_for(isa).doubles);
    compare<double>(Width::four, 4, kernels_for(isa).doubles);
    compare<double>(Width::eight, 8, kernels_for(isa).doubles);
  }
}

TEST(Lane, OperationsOfFloatsAreThoseOfOneFloatOnAnyIsa) {
  for (const lane::Isa isa : each_isa()) {
    compare<float>(Width::one, 1, kernels_for(isa).floats);
    compare<float>(Width::eight, 8, kernels_for(isa).floats);
    compare<float>(Width::sixteen, 16, kernels_for(isa).floats);
  }
}

TEST(Lane, TheEnvironmentMayAskForALesserInstructionSet) {
  const lane::Isa best = lane::best_isa();
  const char* const before = std::getenv("MURO_ISA");
  const std::string kept = before ? before : "";
  setenv("MURO_ISA", "base", 1);
  EXPECT_EQ(lane::best_isa(), lane::Isa::base);
  EXPECT_EQ(&kernels_for(lane::best_isa()), &base::kernels);
  setenv("MURO_ISA", "avx2", 1);
  EXPECT_EQ(lane::best_isa(), std::min(best, lane::Isa::avx2));
  before ? setenv("MURO_ISA", kept.c_str(), 1) : unsetenv("MURO_ISA");
}

}  // namespace
}  // namespace muro::lane_test
