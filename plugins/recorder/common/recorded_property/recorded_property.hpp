// SPDX-License-Identifier: MIT
// Properties that recorders select by patterns of their names.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "muro/connector.hpp"

namespace muro {

/// A property to be recorded, bound.
class RecordedProperty {
 public:
  /// Binds `property`. [setup]
  RecordedProperty(Connector& connector, const FoundProperty& property, std::string name);

  const std::string& name() const { return name_; }  ///< "object:property"
  Scalar scalar() const { return scalar_; }
  /// Titles of its columns: "object:property.x", of arrays "object:property[2].x".
  std::vector<std::string> titles() const;
  /// Parts of the titles after the name: "", ".x", "[2].x".
  std::vector<std::string> elements() const;
  /// Calls `visit` with the address of each scalar, in the order of the titles.
  template <class Visit>
  void each(Visit visit) const {
    if (is_sum_) return each_sum(visit);
    const auto* array = static_cast<const ArrayHeader*>(data_);
    multiplicity_ == Multiplicity::array ? each_of(array->data, array->size, visit) : each_of(data_, 1, visit);
  }

 private:
  template <class Visit>
  void each_of(const void* first, std::uint64_t elements, Visit visit) const {
    const auto* scalar = static_cast<const unsigned char*>(first);
    const std::uint64_t scalars = elements * (labels_.empty() ? 1 : labels_.size());
    for (std::uint64_t i = 0; i < scalars; ++i, scalar += size_of(scalar_)) visit(scalar);
  }

  template <class Visit>
  void each_sum(Visit visit) const {
    const auto* sum = static_cast<const SumHeader*>(data_);
    for (std::size_t i = 0; i < std::max<std::size_t>(labels_.size(), 1); ++i) {
      double total = 0;
      for (std::uint64_t k = 0; k < sum->size; ++k) total += static_cast<const double*>(sum->slots[k])[i];
      visit(&total);
    }
  }

  std::string name_;
  Multiplicity multiplicity_;
  Scalar scalar_;
  std::span<const std::string_view> labels_;
  const void* data_ = nullptr;  ///< the value, an ArrayHeader, or a SumHeader
  bool is_sum_ = false;
};

/// Returns the properties that match any of the patterns "object:property", each property once; * matches any
/// characters and ? matches one. Without patterns, returns the pose of every robot's base. Throws Error when a pattern
/// matches none.
///
/// A pattern with a wildcard skips constants, states that only their owner understands (`state.*`), and properties
/// without fixed columns (shapes, lists). A name without wildcards selects a constant, too; a property without fixed
/// columns is then an error.
std::vector<RecordedProperty> select(Connector& connector, std::span<const std::string_view> patterns);

}  // namespace muro
