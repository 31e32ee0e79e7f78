// SPDX-License-Identifier: MIT
// Numbers of any kind that algorithms add to the report of a run.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A number in the report: `properties: [{name: ball/body:pose, .x: 0.31}]`.
struct ReportNumber {
  std::string_view section;  ///< "properties"
  std::string_view name;     ///< of what the number is of, "ball/body:pose"
  std::string_view key;      ///< ".x"
  double value = 0;          ///< stands without a point where it is a whole number, as null where it is not finite
};

/// An extension of hosts, version 1: as ReportEntries, whose counts stand in the same sections.
class ReportNumbers {
 public:
  /// Set again, the later value stands. The texts are copied. [finish]
  virtual void set_number(const ReportNumber& number) noexcept = 0;

  static ExtensionId id() noexcept;
  /// The host's, or null where it has none. [setup]
  static ReportNumbers* of(Host& host) { return static_cast<ReportNumbers*>(host.find_extension(id())); }

 protected:
  ~ReportNumbers() = default;
};

inline ExtensionId ReportNumbers::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(ReportNumber), MURO_PLACE(ReportNumber, section),
                                           MURO_PLACE(ReportNumber, name), MURO_PLACE(ReportNumber, key),
                                           MURO_PLACE(ReportNumber, value)};
  return {"muro.ReportNumbers", 1, abi::extension_layout<ReportNumbers>(structs, &ReportNumbers::set_number)};
}

}  // namespace muro
