// SPDX-License-Identifier: MIT
// Numbers that algorithms add to the report of a run.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A number in the report: `streams: [{name: rovers_3/laser, clients: 2}]`.
struct ReportEntry {
  std::string_view section;  ///< "streams"
  std::string_view name;     ///< name of the thing that has the number, "rovers_3/laser"
  std::string_view key;      ///< "clients"
  double value = 0;          ///< a whole number is written without a point, a number that is not finite as null
};

/// An extension of hosts, version 2. The report has the numbers in the order in which they were set first. An algorithm
/// sets them in `finish`.
class ReportEntries {
 public:
  /// A later value replaces an earlier one. Copies the texts. [finish]
  virtual void set(const ReportEntry& entry) noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static ReportEntries* of(Host& host) { return static_cast<ReportEntries*>(host.find_extension(id())); }

 protected:
  ~ReportEntries() = default;
};

inline ExtensionId ReportEntries::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(ReportEntry), MURO_PLACE(ReportEntry, section),
                                           MURO_PLACE(ReportEntry, name), MURO_PLACE(ReportEntry, key),
                                           MURO_PLACE(ReportEntry, value)};
  return {"muro.ReportEntries", 2, abi::extension_layout<ReportEntries>(structs, &ReportEntries::set)};
}

}  // namespace muro
