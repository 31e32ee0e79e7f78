// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "plugins/common/text/with_scalar.hpp"
#include "plugins/recorder/common/recorded_property/recorded_property.hpp"

namespace muro {

/// The mean of each number of some properties, over the values that it is told of.
class Means {
 public:
  Means() = default;
  explicit Means(std::vector<RecordedProperty> properties) : properties_(std::move(properties)) {}

  /// Those of the properties, with ".mean" at their ends.
  std::vector<std::string> titles() const {
    std::vector<std::string> titles;
    for (const RecordedProperty& p : properties_)
      for (const std::string& title : p.titles()) titles.push_back(title + ".mean");
    return titles;
  }
  /// Begins with no values. The first call, after which properties have their sizes, allocates.
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
  /// Calls `visit` with each mean, in the order of the titles; they are no numbers where nothing was added.
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
