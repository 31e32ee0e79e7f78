// SPDX-License-Identifier: MIT
// Conversion of the number type of a property, which is known only at run time, to a type of C++.
#pragma once

#include <cstdint>

#include "muro/value_type.hpp"

namespace muro {

/// Calls `visit` with a 0 of the type of a scalar: `[&]<class T>(T) { ... }`. Opaque and transient values have none and
/// are taken for double; callers must exclude them.
template <class Visit>
auto with_scalar(Scalar scalar, Visit visit) {
  switch (scalar) {
    case Scalar::f32:
      return visit(float{});
    case Scalar::i64:
      return visit(std::int64_t{});
    case Scalar::i32:
      return visit(std::int32_t{});
    case Scalar::u64:
      return visit(std::uint64_t{});
    case Scalar::u32:
      return visit(std::uint32_t{});
    case Scalar::u8:
      return visit(std::uint8_t{});
    case Scalar::f64:
    case Scalar::opaque:
    case Scalar::transient:
      break;
  }
  return visit(double{});
}

}  // namespace muro
