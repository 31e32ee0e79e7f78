// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <type_traits>
#include <utility>

namespace muro::detail {

/// The type of the elements of an array, a vector or a span.
template <class Elements>
using ElementOf = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const Elements&>()))>>;

/// Returns element `i` of elements that lie `stride` bytes apart.
template <class T>
constexpr const T& row(const T* first, std::size_t stride, std::size_t i) {
  if (stride == sizeof(T)) return first[i];
  return *reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(first) + i * stride);
}

/// The iterator of Rows.
template <class T>
class RowIterator {
 public:
  using iterator_category = std::forward_iterator_tag;
  using value_type = T;
  using difference_type = std::ptrdiff_t;
  using pointer = const T*;
  using reference = const T&;

  constexpr RowIterator() = default;
  constexpr RowIterator(const T* first, std::size_t stride, std::size_t at) : first_(first), stride_(stride), at_(at) {}
  constexpr const T& operator*() const { return row(first_, stride_, at_); }
  constexpr const T* operator->() const { return &**this; }
  constexpr RowIterator& operator++() { return ++at_, *this; }
  constexpr RowIterator operator++(int) { return {first_, stride_, at_++}; }
  friend constexpr bool operator==(const RowIterator& a, const RowIterator& b) { return a.at_ == b.at_; }
  friend constexpr std::ptrdiff_t operator-(const RowIterator& a, const RowIterator& b) {
    return std::ptrdiff_t(a.at_) - std::ptrdiff_t(b.at_);
  }

 private:
  const T* first_ = nullptr;
  std::size_t stride_ = sizeof(T), at_ = 0;
};

}  // namespace muro::detail
