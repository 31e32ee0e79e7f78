// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "muro/ext/report_entries.hpp"

namespace muro {

/// Numbers that algorithms have set for the report, in the order in which they were set first.
class ReportedNumbers final : public ReportEntries {
 public:
  template <class T>
  using Named = std::vector<std::pair<std::string, T>>;
  using Numbers = Named<double>;
  using Section = Named<Numbers>;

  void set(const ReportEntry& entry) noexcept override {
    at(at(at(sections_, entry.section), entry.name), entry.key) = entry.value;
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
