// SPDX-License-Identifier: MIT
#include "port.hpp"

#include <cmath>
#include <limits>

namespace muro::control {

namespace {

/// Calls `visit` with a null pointer to the C++ type of a scalar.
template <class Visit>
auto with_type(Scalar scalar, Visit visit) {
  switch (scalar) {
    case Scalar::f32:
      return visit(static_cast<float*>(nullptr));
    case Scalar::i64:
      return visit(static_cast<std::int64_t*>(nullptr));
    case Scalar::i32:
      return visit(static_cast<std::int32_t*>(nullptr));
    case Scalar::u64:
      return visit(static_cast<std::uint64_t*>(nullptr));
    case Scalar::u32:
      return visit(static_cast<std::uint32_t*>(nullptr));
    case Scalar::u8:
      return visit(static_cast<std::uint8_t*>(nullptr));
    case Scalar::f64:
    case Scalar::opaque:
    case Scalar::transient:
      break;  // refused at set-up
  }
  return visit(static_cast<double*>(nullptr));
}

/// `value` as T, rounded; false when it does not fit.
template <class T>
bool convert(double value, T& result) {
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(T(value))) return false;
    result = T(value);
    return true;
  } else {
    using Limits = std::numeric_limits<T>;
    const double whole = std::nearbyint(value);
    // 2^digits is the first number above the largest, and exact as a double
    if (!(whole >= double(Limits::min()) && whole < std::ldexp(1.0, Limits::digits))) return false;
    result = T(whole);
    return true;
  }
}

}  // namespace

void Port::add(const FoundProperty& property, void* handle) {
  segments_.push_back({.handle = handle,
                       .multiplicity = property.multiplicity,
                       .scalar = property.key->type->scalar,
                       .per_element = property.key->type->scalars()});
}

void Port::resolve() {
  size_ = 0;
  for (Segment& s : segments_) {
    s.data = s.handle;
    s.count = s.per_element;
    if (s.multiplicity == Multiplicity::array) {
      const auto* array = static_cast<const ArrayHeader*>(s.handle);
      s.data = array->data;
      s.count = std::uint32_t(array->size) * s.per_element;
    }
    size_ += s.count;
  }
  direct_ =
      segments_.size() == 1 && segments_[0].scalar == Scalar::f64 ? static_cast<double*>(segments_[0].data) : nullptr;
}

void Port::read(double* to) const {
  for (const Segment& s : segments_)
    with_type(s.scalar, [&](auto* type) {
      const auto* from = static_cast<decltype(type)>(s.data);
      for (std::uint32_t i = 0; i < s.count; ++i) *to++ = double(from[i]);
    });
}

bool Port::write(const double* from, std::uint32_t& bad) const {
  const double* next = from;
  for (const Segment& s : segments_) {
    const bool fits = with_type(s.scalar, [&](auto* type) {
      auto* to = static_cast<decltype(type)>(s.data);
      for (std::uint32_t i = 0; i < s.count; ++i, ++next)
        if (!convert(*next, to[i])) return false;
      return true;
    });
    if (fits) continue;
    bad = std::uint32_t(next - from);
    return false;
  }
  return true;
}

}  // namespace muro::control
