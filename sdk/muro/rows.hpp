// SPDX-License-Identifier: MIT
// Elements of structs that may grow at their end within a major version of the SDK.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <type_traits>

#include "muro/detail/row_iterator.hpp"

namespace muro {

/// A copy of the struct at `from`, of which its maker knows the first `size` bytes; the other members have their
/// default values.
template <class T>
T known_part(const void* from, std::size_t size) {
  T copy{};
  std::memcpy(static_cast<void*>(&copy), from, size < sizeof(T) ? size : sizeof(T));
  return copy;
}

/// A view of elements that lie `stride()` bytes apart: sizeof(T) for their maker. Minor versions of the SDK add members
/// to a struct at its end, so a reader of an older version finds the members that it knows. A reader of a newer version
/// takes `known(i)`; in a plugin none of its hosts is older.
template <class T>
class Rows {
 public:
  using Iterator = detail::RowIterator<T>;

  constexpr Rows() = default;
  constexpr Rows(const T* first, std::size_t count, std::size_t stride = sizeof(T))
      : first_(first), size_(std::uint32_t(count)), stride_(std::uint32_t(stride)) {}
  /// Elements that lie one after the other: an array, a vector, a span. They outlive the view.
  template <class Elements, class = std::enable_if_t<std::is_same_v<detail::ElementOf<Elements>, T>>>
  constexpr Rows(const Elements& elements) : Rows(std::data(elements), std::size(elements)) {}
  Rows(std::initializer_list<T>) = delete;  // its elements would end with the statement

  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr std::size_t stride() const { return stride_; }  ///< bytes
  constexpr const T& operator[](std::size_t i) const { return detail::row(first_, stride_, i); }
  constexpr const T& front() const { return (*this)[0]; }
  constexpr const T& back() const { return (*this)[size_ - 1u]; }
  constexpr Iterator begin() const { return {first_, stride_, 0}; }
  constexpr Iterator end() const { return {first_, stride_, size_}; }
  /// A copy of element `i`; members that its maker did not know have their default values.
  T known(std::size_t i) const { return known_part<T>(&(*this)[i], stride_); }

 private:
  const T* first_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t stride_ = sizeof(T);
};

}  // namespace muro
