// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro_controller.h"

namespace muro::control {

/// Types of the elements of a port.
enum class PortType : std::uint8_t { number, integer, text };

constexpr PortType type_of(const muro_port& port) {
  if ((port.flags & MURO_PORT_TEXT) != 0) return PortType::text;
  return (port.flags & MURO_PORT_INTEGER) != 0 ? PortType::integer : PortType::number;
}
constexpr bool has_flag(const muro_port& port, std::uint32_t flag) { return (port.flags & flag) != 0; }

/// Returns a table with all fields; fields beyond the end of an older table are zero.
muro_controller_table complete(const muro_controller_table& table);

/// A library's description without its functions. It is in our own memory, so it may come from another process.
struct ControlTable {
  struct Tunable {
    std::string name, unit, doc;
    double default_value = 0, min = 0, max = 0;

    bool is_bounded() const { return min != max; }
  };
  struct Task {
    std::string name;
    double rate = 0;  ///< Hz
  };

  ControlTable() = default;
  ControlTable(ControlTable&&) = default;
  ControlTable& operator=(ControlTable&&) = default;
  ControlTable(const ControlTable&) = delete;
  ControlTable& operator=(const ControlTable&) = delete;

  std::string name, version;
  std::vector<muro_port> inputs, outputs;  ///< `texts` holds their texts
  std::uint64_t state_size = 0;            ///< bytes that a step leaves for the next: state block, or saved data
  bool has_instances = false;              ///< instances have their own memory
  bool can_save = false;                   ///< such instances can be saved and loaded
  std::vector<Tunable> tunables;
  std::vector<Task> tasks;
  std::deque<std::string> texts;

  /// Whether the state contains everything that a step leaves for the next one.
  bool is_restorable() const { return !has_instances || can_save; }
  void add_port(std::vector<muro_port>& to, std::string_view port, const char* unit, std::uint32_t size,
                std::uint32_t flags);
};

/// Returns the description of a checked table; see check_table.
ControlTable describe(const muro_controller_table& table);

/// Returns the value of each tunable: from the scenario, else its default. Throws Error when the library does not have
/// the name or when the value is out of its range.
std::vector<double> read_tunables(std::span<const std::string_view> texts, const ControlTable& table);

/// Returns the rate of each task, Hz: from the scenario, else the library's own. Throws Error.
std::vector<double> read_rates(std::span<const std::string_view> texts, const ControlTable& table);

/// Returns the tunables with these values as text: "speed=0.8 m/s, gain=2".
std::string shown(const ControlTable& table, std::span<const double> values);

}  // namespace muro::control
