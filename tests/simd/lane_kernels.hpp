// SPDX-License-Identifier: MIT
// Kernels for tests of lanes: every operation, one value at a time and in lanes, built for each instruction set.
#pragma once

#include <cstddef>

#include "muro/simd/isa.hpp"

namespace muro::lane_test {

enum class Operation {
  add,
  subtract,
  multiply,
  divide,
  negate,
  add_to,
  subtract_from,
  multiply_by,
  less,
  less_or_equal,
  greater,
  greater_or_equal,
  equal,
  both,
  either,
  neither,
  minimum,
  maximum,
  magnitude,
  root,
  broadcast,
};
inline constexpr int operations = int(Operation::broadcast) + 1;
inline constexpr int values = 16;  ///< in each array

enum class Width { one, four, eight, sixteen };  ///< values at a time

/// Comparisons choose a or b. `bits`: values chosen from a (0 for other operations).
struct Kernels {
  void (*doubles)(Operation, Width, const double* a, const double* b, double* out, unsigned* bits);  ///< not sixteen
  void (*floats)(Operation, Width, const float* a, const float* b, float* out, unsigned* bits);      ///< not four
  void (*sincos)(Width, const double* angles, double* sines, double* cosines);                       ///< one or eight
  /// Copies n = 1 to 8 numbers, from number `first` on, from each of four or eight places to each of as many others.
  void (*copy_rows)(Width, int n, const double* const* from, double* const* to, std::ptrdiff_t first, unsigned which);
  /// Copies a vector, a pose and a twist, one after the other.
  void (*copy_properties)(const double* const* from, double* const* to, unsigned which);
};
MURO_DECLARE_KERNELS(Kernels, kernels)

}  // namespace muro::lane_test
