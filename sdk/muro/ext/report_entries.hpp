// SPDX-License-Identifier: MIT
// What algorithms add to the report of a run.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A count in the report: `streams: [{name: rovers_3/laser, clients: 2}]`.
struct ReportEntry {
  std::string_view section;  ///< "streams"
  std::string_view name;     ///< of what is counted, "rovers_3/laser"
  std::string_view key;      ///< "clients"
  std::uint64_t value = 0;
};

/// An extension of hosts, version 1: numbers that stand in the report of a run, in the order in which they were set
/// first. An algorithm sets them in `finish`.
class ReportEntries {
 public:
  /// Set again, the later value stands. The texts are copied. [finish]
  virtual void set(const ReportEntry& entry) noexcept = 0;

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
  static ReportEntries* of(Host& host) { return static_cast<ReportEntries*>(host.find_extension(id())); }

 protected:
  ~ReportEntries() = default;
};

inline ExtensionId ReportEntries::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(ReportEntry), MURO_PLACE(ReportEntry, section),
                                           MURO_PLACE(ReportEntry, name), MURO_PLACE(ReportEntry, key),
                                           MURO_PLACE(ReportEntry, value)};
  return {"muro.ReportEntries", 1, abi::extension_layout<ReportEntries>(structs, &ReportEntries::set)};
}

}  // namespace muro
