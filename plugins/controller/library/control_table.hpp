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

/// What the elements of a port are.
enum class PortType : std::uint8_t { number, integer, text };

constexpr PortType type_of(const muro_port& port) {
  if ((port.flags & MURO_PORT_TEXT) != 0) return PortType::text;
  return (port.flags & MURO_PORT_INTEGER) != 0 ? PortType::integer : PortType::number;
}
constexpr bool has_flag(const muro_port& port, std::uint32_t flag) { return (port.flags & flag) != 0; }

/// A table whose fields are all there: those behind the end of an older one are zero.
muro_controller_table complete(const muro_controller_table& table);

/// What a library says of itself, without its functions: in memory of our own, so that it may come from another
/// process.
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
  std::vector<muro_port> inputs, outputs;  ///< their texts are in `texts`
  std::uint64_t state_size = 0;            ///< bytes that a step leaves for the next: of the block, or of what is saved
  bool has_instances = false;              ///< with memory of their own
  bool can_save = false;                   ///< these instances can be saved and loaded
  std::vector<Tunable> tunables;
  std::vector<Task> tasks;
  std::deque<std::string> texts;

  /// Whether all that a step leaves for the next one is in the state.
  bool is_restorable() const { return !has_instances || can_save; }
  void add_port(std::vector<muro_port>& to, std::string_view port, const char* unit, std::uint32_t size,
                std::uint32_t flags);
};

/// Of a checked table, see check_table.
ControlTable describe(const muro_controller_table& table);

/// The value of each tunable: what the scenario sets, else its default. Throws Error for a name that the library does
/// not have and for a value out of its range.
std::vector<double> read_tunables(std::span<const std::string_view> texts, const ControlTable& table);

/// Hz, of each task: what the scenario sets, else what the library asks for. Throws Error.
std::vector<double> read_rates(std::span<const std::string_view> texts, const ControlTable& table);

/// "speed=0.8 m/s, gain=2": the tunables with these values.
std::string shown(const ControlTable& table, std::span<const double> values);

}  // namespace muro::control
