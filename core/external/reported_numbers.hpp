// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "muro/ext/report_entries.hpp"
#include "muro/ext/report_numbers.hpp"

namespace muro {

/// Numbers that algorithms have given for the report, in the order in which each was given first.
class ReportedNumbers final : public ReportEntries, public ReportNumbers {
 public:
  template <class T>
  using Named = std::vector<std::pair<std::string, T>>;
  using Numbers = Named<double>;
  using Section = Named<Numbers>;

  void set(const ReportEntry& entry) noexcept override {
    at(at(at(sections_, entry.section), entry.name), entry.key) = double(entry.value);
  }
  void set_number(const ReportNumber& number) noexcept override {
    at(at(at(sections_, number.section), number.name), number.key) = number.value;
  }
  const Named<Section>& sections() const { return sections_; }

 private:
  template <class T>
  static T& at(Named<T>& all, std::string_view name) {
    // search from the end: numbers that belong together are given one after the other
    for (auto i = all.rbegin(); i != all.rend(); ++i)
      if (i->first == name) return i->second;
    return all.emplace_back(std::string(name), T{}).second;
  }

  Named<Section> sections_;
};

}  // namespace muro
