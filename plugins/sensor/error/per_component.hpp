// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace muro {

/// A setting of a reading: one number for all components, or one for each component. Without numbers it is 0.
class PerComponent {
 public:
  PerComponent() = default;
  PerComponent(double value) : values_{value} {}  // NOLINT(google-explicit-constructor): a number is one
  explicit PerComponent(std::span<const double> values) : values_(values.begin(), values.end()) {}

  double operator[](std::size_t component) const {
    if (values_.empty()) return 0;
    return values_.size() == 1 ? values_[0] : values_[component];
  }
  bool is_zero() const {
    return std::all_of(values_.begin(), values_.end(), [](double v) { return v == 0; });
  }
  /// Returns how many numbers were given.
  std::size_t size() const { return values_.size(); }
  template <class Function>
  PerComponent map(Function function) const {
    PerComponent result;
    for (const double v : values_) result.values_.push_back(function(v));
    return result;
  }
  /// Returns `function` of this setting and of another one of the same reading.
  template <class Function>
  PerComponent with(const PerComponent& other, Function function) const {
    PerComponent result;
    for (std::size_t i = 0; i < std::max(size(), other.size()); ++i)
      result.values_.push_back(function((*this)[i], other[i]));
    return result;
  }

 private:
  std::vector<double> values_;
};

/// Places of the states of the stages of a chain: numbers in one block, which begins as zeros.
class StateLayout {
 public:
  /// Reserves `count` numbers. Returns the place of the first one.
  std::size_t reserve(std::size_t count) {
    const std::size_t first = size_;
    size_ += count;
    return first;
  }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
};

}  // namespace muro
