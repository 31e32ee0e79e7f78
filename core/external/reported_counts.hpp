// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "muro/ext/report_entries.hpp"

namespace muro {

/// Counts that algorithms have told for the report, in the order in which they were told first.
class ReportedCounts final : public ReportEntries {
 public:
  template <class T>
  using Named = std::vector<std::pair<std::string, T>>;
  using Counts = Named<std::uint64_t>;
  using Section = Named<Counts>;

  void set(const ReportEntry& entry) noexcept override {
    at(at(at(sections_, entry.section), entry.name), entry.key) = entry.value;
  }
  const Named<Section>& sections() const { return sections_; }

 private:
  template <class T>
  static T& at(Named<T>& all, std::string_view name) {
    // the last one first: what belongs together is told in a row
    for (auto i = all.rbegin(); i != all.rend(); ++i)
      if (i->first == name) return i->second;
    return all.emplace_back(std::string(name), T{}).second;
  }

  Named<Section> sections_;
};

}  // namespace muro
