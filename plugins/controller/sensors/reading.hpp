// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "muro/connector.hpp"

namespace muro::sensors {

/// A property that clients read: a numeric value or an array of such values.
class Reading {
 public:
  /// `property` must be readable; see why_unreadable(). [setup]
  Reading(Connector& connector, const FoundProperty& property, std::string name);

  /// Returns "" when a property is readable; else the reason, as the end of a sentence that begins with its name.
  static std::string why_unreadable(const FoundProperty& property);

  const std::string& name() const { return name_; }
  std::string_view unit() const { return unit_; }
  /// Returns the labels of one element: "x,y,z"; "-" when it is a single number.
  std::string labels() const;
  std::size_t size() const;  ///< number of values; known from start() on
  void add_to(std::vector<double>& out) const;

 private:
  void add_scalars(const void* first, std::uint64_t elements, std::vector<double>& out) const;

  std::string name_;
  std::string unit_;
  const ValueType& type_;
  bool is_array_ = false, is_sum_ = false;
  const void* data_ = nullptr;  ///< value, ArrayHeader or SumHeader
};

}  // namespace muro::sensors
