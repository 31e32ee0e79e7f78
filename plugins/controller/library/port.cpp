// SPDX-License-Identifier: MIT
#include "port.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "muro/object.hpp"
#include "muro/scene.hpp"
#include "plugins/common/text/with_scalar.hpp"

namespace muro::control {

namespace {

/// Whether `value` fits into T. It is rounded first when T is an integer type.
template <class T>
bool fits(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(T(value));
  } else {
    using Limits = std::numeric_limits<T>;
    const double whole = std::nearbyint(value);
    // 2^digits is the first number above the largest, and exact as a double
    return whole >= double(Limits::min()) && whole < std::ldexp(1.0, Limits::digits);
  }
}
/// Whether `value` fits into T. Unsigned integers of 64 bits get the same bits.
template <class T>
bool fits(std::int64_t value) {
  if constexpr (std::is_floating_point_v<T> || sizeof(T) == 8)
    return true;
  else
    return value >= std::int64_t(std::numeric_limits<T>::min()) && value <= std::int64_t(std::numeric_limits<T>::max());
}

template <class T, class Number>
T converted(Number value) {
  if constexpr (std::is_floating_point_v<Number> && !std::is_floating_point_v<T>)
    return T(std::nearbyint(value));
  else
    return T(value);
}

/// Appends as much of a text as there is room for.
char* append(char* to, const char* end, std::string_view text) {
  const std::size_t size = std::min(text.size(), std::size_t(end - to));
  std::memcpy(to, text.data(), size);
  return to + size;
}

}  // namespace

bool rests_at_zero(std::string_view unit) { return unit.starts_with("N") || unit.find("/s") != unit.npos; }

void Port::add(const FoundProperty& property, void* handle) {
  segments_.push_back({.handle = handle,
                       .multiplicity = property.multiplicity,
                       .scalar = property.key->type->scalar,
                       .per_element = is_contact(*property.key) ? numbers_of_contact : property.key->type->scalars(),
                       .is_contact = is_contact(*property.key),
                       .rests_at_zero = rests_at_zero(property.key->unit)});
}

void Port::add_follower(std::size_t leader, double multiplier, double offset) {
  Segment& s = segments_.emplace_back();
  s.leader = std::int32_t(leader), s.multiplier = multiplier, s.offset = offset;
}

void Port::add_objects(const FoundProperty& property, void* handle, ObjectNames names) {
  add(property, handle);
  segments_.back().names = std::move(names);
}

void Port::add_text(std::string text) { segments_.emplace_back().text = std::move(text); }

void Port::resolve(Segment& s) const {
  s.data = s.handle;
  s.count = s.handle || s.is_led() ? s.per_element : 0;
  if (s.multiplicity == Multiplicity::array) {
    const auto* array = static_cast<const ArrayHeader*>(s.handle);
    s.data = array->data;
    s.count = std::uint32_t(array->size) * s.per_element;
  }
}

void Port::resolve() {
  size_ = 0;
  std::size_t length = segments_.size();  // for texts: line ends and the closing zero
  for (Segment& s : segments_) {
    resolve(s);
    size_ += s.count;
    if (type_ == PortType::text) length += longest_text(s);
  }
  if (type_ == PortType::text) size_ = segments_.empty() ? 0 : std::uint32_t(length);
  const bool is_list = std::any_of(segments_.begin(), segments_.end(),
                                   [](const Segment& s) { return s.multiplicity == Multiplicity::list; });
  if (capacity_ > 0 && !segments_.empty() && (type_ == PortType::text || is_list)) size_ = capacity_;
  const Scalar own = type_ == PortType::number ? Scalar::f64 : Scalar::i64;
  const bool is_direct = type_ != PortType::text && !is_list && segments_.size() == 1 && segments_[0].scalar == own;
  direct_ = is_direct ? segments_[0].data : nullptr;
}

/// Returns the length without the closing zero.
std::size_t Port::longest_text(const Segment& s) {
  if (!s.handle) return s.text.size();
  if (!s.names) return s.count;
  std::size_t longest = 0;
  for (const std::string& name : *s.names) longest = std::max(longest, name.size());
  return s.count * (longest + 1);
}

std::uint32_t Port::read_text(char* to) const {
  char *next = to, *const end = to + size_ - 1;
  for (const Segment& s : segments_) {
    if (&s != segments_.data()) next = append(next, end, "\n");
    if (s.names) {
      const auto* ids = static_cast<const ObjectId*>(s.data);
      for (std::uint32_t i = 0; i < s.count; ++i) {
        if (i > 0) next = append(next, end, "\n");
        if (index_of(ids[i]) < s.names->size()) next = append(next, end, (*s.names)[index_of(ids[i])]);
      }
    } else if (s.handle) {
      const auto* bytes = static_cast<const char*>(s.data);
      next = append(next, end, {bytes, strnlen(bytes, s.count)});
    } else {
      next = append(next, end, s.text);
    }
  }
  *next = 0;
  return std::uint32_t(next - to) + 1;
}

/// Reads whole elements, as many as there is room for.
std::uint32_t Port::read_list(const Segment& s, double* to) const {
  const auto* list = static_cast<const ListHeader*>(s.handle);
  const auto most = std::min<std::uint64_t>(list->size, size_ / s.per_element);
  if (s.is_contact) {
    const auto* contacts = static_cast<const Contact*>(list->data);
    for (const Contact& c : std::span(contacts, most)) {
      for (int k = 0; k < 3; ++k) to[k] = c.point[k], to[3 + k] = c.normal[k];
      to[6] = c.depth;
      to += numbers_of_contact;
    }
  } else {
    with_scalar(s.scalar, [&]<class T>(T) {
      const auto* from = static_cast<const T*>(list->data);
      for (std::uint64_t i = 0; i < most * s.per_element; ++i) to[i] = double(from[i]);
    });
  }
  return std::uint32_t(most) * s.per_element;
}

double Port::of_leader(const Segment& follower) const {
  const Segment& leader = segments_[std::size_t(follower.leader)];
  return follower.offset + follower.multiplier * *static_cast<const double*>(leader.data);
}

std::uint32_t Port::read(void* to) const {
  if (segments_.empty()) return 0;
  if (type_ == PortType::text) return read_text(static_cast<char*>(to));
  if (segments_[0].multiplicity == Multiplicity::list) return read_list(segments_[0], static_cast<double*>(to));
  const auto copy = [&](auto* next) {
    using Number = std::remove_pointer_t<decltype(next)>;
    for (const Segment& s : segments_) {
      if (s.is_led()) {
        *next++ = Number(of_leader(s));
        continue;
      }
      with_scalar(s.scalar, [&]<class T>(T) {
        const auto* from = static_cast<const T*>(s.data);
        for (std::uint32_t i = 0; i < s.count; ++i) *next++ = Number(from[i]);
      });
    }
  };
  if (type_ == PortType::number)
    copy(static_cast<double*>(to));
  else
    copy(static_cast<std::int64_t*>(to));
  return size_;
}

/// Calls `write` with each place and its new number; stops when it returns false.
template <class T, class Write>
bool Port::each_of(const void* from, std::uint32_t& bad, Write write) const {
  const T* next = static_cast<const T*>(from);
  for (const Segment& s : segments_) {
    if (s.is_led()) {
      ++next;
      continue;
    }
    const bool fine = with_scalar(s.scalar, [&]<class Held>(Held) {
      auto* to = static_cast<Held*>(s.data);
      for (std::uint32_t i = 0; i < s.count; ++i, ++next)
        if (!write(to[i], *next)) return false;
      return true;
    });
    if (fine) continue;
    bad = std::uint32_t(next - static_cast<const T*>(from));
    return false;
  }
  return true;
}

void Port::rest() const {
  for (const Segment& s : segments_)
    if (s.rests_at_zero && s.data) std::memset(s.data, 0, s.count * size_of(s.scalar));
}

bool Port::write(const void* from, std::uint32_t& bad) const {
  if (segments_.empty()) return true;
  if (type_ == PortType::text) {
    const auto* text = static_cast<const char*>(from);
    const std::size_t length = strnlen(text, size_);
    bad = std::uint32_t(length);
    if (length == size_ || length > segments_[0].count) return false;
    auto* to = static_cast<char*>(segments_[0].data);
    std::memcpy(to, text, length);
    std::memset(to + length, 0, segments_[0].count - length);
    return true;
  }
  const auto check = [](auto& place, auto number) {
    using T = std::remove_reference_t<decltype(place)>;
    return std::isfinite(double(number)) && fits<T>(number);
  };
  const auto set = [](auto& place, auto number) {
    place = converted<std::remove_reference_t<decltype(place)>>(number);
    return true;
  };
  if (type_ == PortType::number) return each_of<double>(from, bad, check) && each_of<double>(from, bad, set);
  return each_of<std::int64_t>(from, bad, check) && each_of<std::int64_t>(from, bad, set);
}

}  // namespace muro::control
