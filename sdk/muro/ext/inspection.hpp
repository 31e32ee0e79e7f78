// SPDX-License-Identifier: MIT
// Properties and costs of a running simulation, for windows and remote controls.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// A property as it lies in memory.
struct LiveProperty {
  const KeyInfo* key = nullptr;
  Multiplicity multiplicity = Multiplicity::single;
  std::uint32_t count = 0;      ///< elements now
  void* data = nullptr;         ///< the first of them
  bool is_constant = false;     ///< given at set-up
  bool is_variable = false;     ///< state: may be edited, elements in place
  std::string_view written_by;  ///< the algorithm; empty: the set-up
};

/// Cost of an algorithm so far.
struct LiveCost {
  std::string_view name;  ///< "rovers.motion"
  std::uint64_t runs = 0;
  double seconds = 0;       ///< of the wall clock, over all threads
  bool runs_alone = false;  ///< the algorithm runs alone: `seconds` may include waiting
};

/// An extension of hosts, version 1. For algorithms that run alone, in their steps: nothing else runs then. Views are
/// valid until the next call.
class Inspection {
 public:
  /// Returns all properties of an object by name, in order of creation. [step]
  virtual std::span<const LiveProperty> properties(ObjectId object) noexcept = 0;
  virtual std::span<const LiveCost> costs() noexcept = 0;
  virtual std::uint32_t object_count() const noexcept = 0;
  /// Returns "?" when there is no such object.
  virtual std::string_view object_name(ObjectId object) const noexcept = 0;
  virtual std::string_view text(TextId id) const noexcept = 0;
  /// Ends the run soon, a few instants later. [step]
  virtual void stop() noexcept = 0;
  /// Whether the run is to end, for any reason: a step that waits returns then. [step]
  virtual bool is_stopping() const noexcept = 0;

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static Inspection* of(Host& host) { return static_cast<Inspection*>(host.find_extension(id())); }

 protected:
  ~Inspection() = default;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
inline ExtensionId Inspection::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(LiveProperty),
                                           MURO_PLACE(LiveProperty, key),
                                           MURO_PLACE(LiveProperty, multiplicity),
                                           MURO_PLACE(LiveProperty, count),
                                           MURO_PLACE(LiveProperty, data),
                                           MURO_PLACE(LiveProperty, is_constant),
                                           MURO_PLACE(LiveProperty, is_variable),
                                           MURO_PLACE(LiveProperty, written_by),
                                           MURO_SIZE(LiveCost),
                                           MURO_PLACE(LiveCost, name),
                                           MURO_PLACE(LiveCost, runs),
                                           MURO_PLACE(LiveCost, seconds),
                                           MURO_PLACE(LiveCost, runs_alone)};
  return {"muro.Inspection", 1,
          abi::extension_layout<Inspection>(structs, &Inspection::properties, &Inspection::costs,
                                            &Inspection::object_count, &Inspection::object_name, &Inspection::text,
                                            &Inspection::stop, &Inspection::is_stopping)};
}
#pragma GCC diagnostic pop

}  // namespace muro
