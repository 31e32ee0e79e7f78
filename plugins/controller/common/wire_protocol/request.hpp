// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace muro::wire {

/// Requests of a client. The numbers are those of the binary protocol.
enum class Verb : std::uint8_t { info = 1, get = 2, set = 3, stop = 4, wait = 5, report = 6, time = 7 };

/// Quantity of a group's numbers. `standard`: the quantity that the group uses when a request names none.
enum class Quantity : std::uint8_t { standard, position, velocity, acceleration, effort, setpoint };
inline constexpr std::string_view quantity_names[] = {"standard",     "position", "velocity",
                                                      "acceleration", "effort",   "setpoint"};
inline constexpr std::size_t quantity_count = 6;
constexpr std::string_view name_of(Quantity q) { return quantity_names[std::size_t(q)]; }

/// Connects a reply of the binary protocol to its request.
struct Tag {
  std::uint8_t sequence = 0;
  bool is_wide = false;  ///< numbers are f64, not f32
};

struct Request {
  Verb verb = Verb::info;
  Tag tag;
  bool names_group = false;
  std::uint32_t group = 0;
  Quantity quantity = Quantity::standard;
  std::int64_t duration = 0;   ///< duration of a `wait`, ns
  double period = 0;           ///< period of a `report`, ns; 0: ends the report
  std::vector<double> values;  ///< numbers of `set`
};

/// Longest duration of a request, ns: 31 years. Longer ones are refused.
inline constexpr std::int64_t longest_duration = 1'000'000'000'000'000'000;

}  // namespace muro::wire
