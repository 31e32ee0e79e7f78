// SPDX-License-Identifier: MIT
// Properties as contiguous numbers, for kernels. Plugins include this; kernels do not.
#pragma once

#include <cstddef>
#include <cstdint>

#include "muro/geometry.hpp"

namespace muro::lane {

static_assert(sizeof(Pose) == 7 * sizeof(double) && sizeof(Twist) == 6 * sizeof(double) &&
              sizeof(Wrench) == 6 * sizeof(double));

inline double* numbers(Pose* p) { return p->position.data(); }
inline double* numbers(Twist* t) { return t->linear.data(); }
inline double* numbers(Wrench* w) { return w->force.data(); }
inline const double* numbers(const Pose* p) { return p->position.data(); }
inline const double* numbers(const Twist* t) { return t->linear.data(); }
inline const double* numbers(const Wrench* w) { return w->force.data(); }

/// Distance from `from` to `to`, in numbers. Robots of one model mostly have their properties at equal distances, so
/// one address and the distances locate all of them. Computed from addresses, since different properties are no array.
inline std::ptrdiff_t numbers_between(const double* from, const double* to) {
  const auto bytes = reinterpret_cast<std::intptr_t>(to) - reinterpret_cast<std::intptr_t>(from);
  return bytes / std::ptrdiff_t(sizeof(double));
}

}  // namespace muro::lane
