// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sleef.h>  // beside our own declarations of it

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "muro/base/elementary.hpp"
#include "muro_elementary.h"

namespace muro {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN();

/// 1 ulp, with the error of the long double that it is compared with.
constexpr double one_unit = 1.001;

/// Returns the error of a double `value` in units in the last place.
double ulps(double value, long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  exponent = std::max(exponent, std::numeric_limits<double>::min_exponent);
  return double(std::abs(std::ldexp((long double)(value)-exact, std::numeric_limits<double>::digits - exponent)));
}

struct Function {
  const char* name;
  double (*ours)(double);
  double (*in_c)(double);
  long double (*exact)(long double);
  double low, high;  ///< range of arguments, some of them over all orders of magnitude
};

const Function functions[] = {
    {"sin", elementary::sin, muro_sin, std::sin, -1e6, 1e6},
    {"cos", elementary::cos, muro_cos, std::cos, -1e6, 1e6},
    {"tan", elementary::tan, muro_tan, std::tan, -1e6, 1e6},
    {"asin", elementary::asin, muro_asin, std::asin, -1, 1},
    {"acos", elementary::acos, muro_acos, std::acos, -1, 1},
    {"atan", elementary::atan, muro_atan, std::atan, -1e9, 1e9},
    {"sinh", elementary::sinh, muro_sinh, std::sinh, -700, 700},
    {"cosh", elementary::cosh, muro_cosh, std::cosh, -700, 700},
    {"tanh", elementary::tanh, muro_tanh, std::tanh, -30, 30},
    {"asinh", elementary::asinh, muro_asinh, std::asinh, -1e9, 1e9},
    {"acosh", elementary::acosh, muro_acosh, std::acosh, 1, 1e9},
    {"atanh", elementary::atanh, muro_atanh, std::atanh, -1, 1},
    {"exp", elementary::exp, muro_exp, std::exp, -700, 700},
    {"exp2", elementary::exp2, muro_exp2, std::exp2, -1000, 1000},
    {"expm1", elementary::expm1, muro_expm1, std::expm1, -700, 700},
    {"log", elementary::log, muro_log, std::log, 0, 1e300},
    {"log2", elementary::log2, muro_log2, std::log2, 0, 1e300},
    {"log10", elementary::log10, muro_log10, std::log10, 0, 1e300},
    {"log1p", elementary::log1p, muro_log1p, std::log1p, -1, 1e300},
    {"cbrt", elementary::cbrt, muro_cbrt, std::cbrt, -1e300, 1e300},
};

class Draws {
 public:
  /// Returns a number between the bounds, uniform or over all orders of magnitude.
  double between(double low, double high) {
    if (unit_(random_) < 0.5) return low + (high - low) * unit_(random_);
    const double bound = unit_(random_) < 0.5 ? high : low, size = bound * std::pow(10, -20 * unit_(random_));
    return std::min(std::max(size, low), high);
  }

 private:
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> unit_{0, 1};
};

TEST(ElementaryFunctions, AreWithinOneUnitInTheLastPlace) {
  Draws draws;
  for (const Function& f : functions) {
    double worst = 0, at = 0;
    for (int i = 0; i < 100'000; ++i) {
      const double x = draws.between(f.low, f.high), off = ulps(f.ours(x), f.exact(x));
      if (off > worst) worst = off, at = x;
    }
    EXPECT_LE(worst, one_unit) << f.name << " of " << at;
    EXPECT_GT(worst, 0) << f.name << ": nothing was compared";
  }
}

TEST(ElementaryFunctions, OfTwoNumbersAreWithinOneUnitInTheLastPlace) {
  Draws draws;
  double pow = 0, atan2 = 0, hypot = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = draws.between(-1e9, 1e9), y = draws.between(-1e9, 1e9), base = draws.between(0, 1e9),
                 exponent = draws.between(-10, 10);
    pow = std::max(pow, ulps(elementary::pow(base, exponent), std::pow((long double)(base), (long double)(exponent))));
    atan2 = std::max(atan2, ulps(elementary::atan2(y, x), std::atan2((long double)(y), (long double)(x))));
    hypot = std::max(hypot, ulps(elementary::hypot(x, y), std::hypot((long double)(x), (long double)(y))));
    EXPECT_EQ(muro_pow(base, exponent), elementary::pow(base, exponent));
    EXPECT_EQ(muro_atan2(y, x), elementary::atan2(y, x));
    EXPECT_EQ(muro_hypot(x, y), elementary::hypot(x, y));
  }
  for (const double worst : {pow, atan2, hypot}) EXPECT_TRUE(worst > 0 && worst <= one_unit) << worst;
}

TEST(ElementaryFunctions, OfHugeAnglesAreWithinOneUnitInTheLastPlace) {
  // example of Ng, Argument Reduction for Huge Arguments: Good to the Last Bit, 1992
  EXPECT_LE(ulps(elementary::sin(1e22), -0.85220084976718880177270589375303L), 1);
  EXPECT_LE(ulps(elementary::cos(1e22), 0.52321478539513894549759442588439L), 1);
  Draws draws;
  for (int i = 0; i < 100'000; ++i) {
    const double x = draws.between(-1e18, 1e18);
    const auto [sine, cosine] = elementary::sincos(x);
    ASSERT_LE(ulps(sine, std::sin((long double)(x))), one_unit) << x;
    ASSERT_LE(ulps(cosine, std::cos((long double)(x))), one_unit) << x;
    double sine_in_c = 0, cosine_in_c = 0;
    muro_sincos(x, &sine_in_c, &cosine_in_c);
    ASSERT_TRUE(sine_in_c == sine && cosine_in_c == cosine);
  }
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

TEST(ElementaryFunctions, HaveTheSpecialValuesOfTheCLibrary) {
  const double special[] = {0.0,   -0.0,   1,      -1,      infinity, -infinity, not_a_number,
                            1e150, -1e150, 5e-324, -5e-324, 1000,     -1000};
  const std::function<double(double)> theirs[] = {
      [](double x) { return std::sin(x); },   [](double x) { return std::cos(x); },
      [](double x) { return std::tan(x); },   [](double x) { return std::asin(x); },
      [](double x) { return std::acos(x); },  [](double x) { return std::atan(x); },
      [](double x) { return std::sinh(x); },  [](double x) { return std::cosh(x); },
      [](double x) { return std::tanh(x); },  [](double x) { return std::asinh(x); },
      [](double x) { return std::acosh(x); }, [](double x) { return std::atanh(x); },
      [](double x) { return std::exp(x); },   [](double x) { return std::exp2(x); },
      [](double x) { return std::expm1(x); }, [](double x) { return std::log(x); },
      [](double x) { return std::log2(x); },  [](double x) { return std::log10(x); },
      [](double x) { return std::log1p(x); }, [](double x) { return std::cbrt(x); }};
  ASSERT_EQ(std::size(theirs), std::size(functions));
  for (std::size_t i = 0; i < std::size(functions); ++i)
    for (const double x : special) {
      const double ours = functions[i].ours(x), c = theirs[i](x);
      const bool ordinary = std::isfinite(c) && c != 0;
      EXPECT_TRUE(ordinary ? std::abs(ours - c) <= 4e-16 * std::abs(c) + 5e-324 : same(ours, c))
          << functions[i].name << "(" << x << ") is " << ours << ", not " << c;
      EXPECT_TRUE(same(functions[i].in_c(x), ours)) << functions[i].name;
    }
}

TEST(ElementaryFunctions, OfTwoNumbersHaveTheSpecialValuesOfC) {
  for (const double x : {0.0, -0.0, 1.0, -1.0, 2.5, -3.0, infinity, -infinity, not_a_number})
    for (const double y : {0.0, -0.0, 1.0, -1.0, 2.5, -3.0, infinity, -infinity, not_a_number}) {
      const auto close = [](double a, double b) { return same(a, b) || std::abs(a - b) <= 4e-16 * std::abs(b); };
      EXPECT_PRED2(close, elementary::atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_PRED2(close, elementary::pow(x, y), std::pow(x, y)) << x << " " << y;
      EXPECT_PRED2(close, elementary::hypot(x, y), std::hypot(x, y)) << x << " " << y;
    }
}

}  // namespace
}  // namespace muro
