// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "plugins/common/text/with_scalar.hpp"
#include "plugins/recorder/common/recorded_property/recorded_property.hpp"

namespace muro {

/// Mean of each number of some properties, over the values that are added.
class Means {
 public:
  Means() = default;
  explicit Means(std::vector<RecordedProperty> properties) : properties_(std::move(properties)) {}

  /// Returns the titles of the properties, with ".mean" at their ends.
  std::vector<std::string> titles() const {
    std::vector<std::string> titles;
    for (const RecordedProperty& p : properties_)
      for (const std::string& title : p.titles()) titles.push_back(title + ".mean");
    return titles;
  }
  /// Removes all values. The first call allocates; properties must have their sizes by then.
  void begin() {
    std::size_t n = 0;
    for (const RecordedProperty& p : properties_) p.each([&](const void*) { ++n; });
    sums_.assign(n, 0);
    count_ = 0;
  }
  /// Adds the present values.
  void add() {
    std::size_t i = 0;
    for (const RecordedProperty& p : properties_)
      with_scalar(p.scalar(), [&]<class T>(T) {
        p.each([&](const void* scalar) { sums_[i++] += double(*static_cast<const T*>(scalar)); });
      });
    ++count_;
  }
  /// Calls `visit` with each mean, in the order of the titles; the means are NaN when nothing was added.
  template <class Visit>
  void each(Visit visit) const {
    for (const double sum : sums_) visit(count_ > 0 ? sum / double(count_) : std::numeric_limits<double>::quiet_NaN());
  }

 private:
  std::vector<RecordedProperty> properties_;
  std::vector<double> sums_;
  std::uint64_t count_ = 0;
};

}  // namespace muro
