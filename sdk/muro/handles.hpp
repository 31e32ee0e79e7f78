// SPDX-License-Identifier: MIT
// Typed access to properties. A handle is one pointer: to read a property in a step costs one load. Connector gives out
// handles; they stay valid until the simulation ends.
#pragma once

#include <cassert>
#include <span>

#include "muro/detail/headers.hpp"

namespace muro {

/// Reads a property.
template <class T>
class In {
 public:
  In() = default;
  explicit In(const void* place) : place_(static_cast<const T*>(place)) {}
  const T& operator*() const { return *place_; }
  const T* operator->() const { return place_; }
  const T* get() const { return place_; }
  explicit operator bool() const { return place_ != nullptr; }

 private:
  const T* place_ = nullptr;
};

/// Writes a property; only one algorithm does.
template <class T>
class Out {
 public:
  Out() = default;
  explicit Out(void* place) : place_(static_cast<T*>(place)) {}
  T& operator*() const { return *place_; }
  T* operator->() const { return place_; }
  T* get() const { return place_; }
  explicit operator bool() const { return place_ != nullptr; }

 private:
  T* place_ = nullptr;
};

/// One contribution to a property that several algorithms add to. Assign it in each step: it keeps its value between
/// steps.
template <class T>
using Sum = Out<T>;

/// Reads the sum of all contributions, added in registration order.
template <class T>
class SumIn {
 public:
  SumIn() = default;
  explicit SumIn(const void* place) : header_(static_cast<const SumHeader*>(place)) {}
  T value() const {
    T total{};
    for (std::uint64_t i = 0; i < size(); ++i) total += *contribution(i);
    return total;
  }
  /// The contributions: all are known from `start()` on.
  std::uint64_t size() const { return header_->size; }
  const T* contribution(std::uint64_t i) const { return static_cast<const T*>(header_->slots[i]); }

 private:
  const SumHeader* header_ = nullptr;
};

/// Reads an array of fixed length. The length is known from `start()` on.
template <class T>
class ArrayIn {
 public:
  ArrayIn() = default;
  explicit ArrayIn(const void* place) : header_(static_cast<const ArrayHeader*>(place)) {}
  std::span<const T> operator*() const { return {static_cast<const T*>(header_->data), header_->size}; }
  explicit operator bool() const { return header_ != nullptr; }

 private:
  const ArrayHeader* header_ = nullptr;
};

/// Writes an array of fixed length.
template <class T>
class ArrayOut {
 public:
  ArrayOut() = default;
  explicit ArrayOut(void* place) : header_(static_cast<ArrayHeader*>(place)) {}
  std::span<T> operator*() const { return {static_cast<T*>(header_->data), header_->size}; }
  explicit operator bool() const { return header_ != nullptr; }

 private:
  ArrayHeader* header_ = nullptr;
};

/// Reads a list whose length changes from step to step. While `revision()` and the length stay the same, each element
/// describes the same thing (a contact of the same bodies, for example); its numbers may change.
template <class T>
class ListIn {
 public:
  ListIn() = default;
  explicit ListIn(const void* place) : header_(static_cast<const ListHeader*>(place)) {}
  std::span<const T> operator*() const { return {static_cast<const T*>(header_->data), header_->size}; }
  std::uint64_t revision() const { return header_->revision; }
  explicit operator bool() const { return header_ != nullptr; }

 private:
  const ListHeader* header_ = nullptr;
};

/// Writes a list whose length changes from step to step. Its memory doubles when it is full, so a run soon stops
/// allocating. A writer may change the numbers of elements in place; it clears the list when elements describe other
/// things than before.
template <class T>
class ListOut {
 public:
  ListOut() = default;
  explicit ListOut(void* place) : header_(static_cast<ListHeader*>(place)) {}
  void clear() const {
    header_->size = 0;
    ++header_->revision;
  }
  void push_back(const T& value) const {
    if (header_->size == header_->capacity) header_->grow(header_, header_->size + 1);
    static_cast<T*>(header_->data)[header_->size++] = value;
  }
  /// Makes room for so many elements, of a list that never has more. [setup]
  void reserve(std::uint64_t count) const {
    if (header_->capacity < count) header_->grow(header_, count);
  }
  std::span<T> operator*() const { return {static_cast<T*>(header_->data), header_->size}; }
  explicit operator bool() const { return header_ != nullptr; }

 private:
  ListHeader* header_ = nullptr;
};

}  // namespace muro
