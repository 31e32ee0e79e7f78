// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace muro::wire {

/// What a client may ask for. The numbers are those of the binary protocol.
enum class Verb : std::uint8_t { info = 1, get = 2, set = 3, stop = 4, wait = 5, report = 6, time = 7 };

/// Which numbers of a group. `standard`: those that the group is read or set by when none are named.
enum class Quantity : std::uint8_t { standard, position, velocity, acceleration, effort, setpoint };
inline constexpr std::string_view quantity_names[] = {"standard",     "position", "velocity",
                                                      "acceleration", "effort",   "setpoint"};
inline constexpr std::size_t quantity_count = 6;
constexpr std::string_view name_of(Quantity q) { return quantity_names[std::size_t(q)]; }

/// By what a reply of the binary protocol belongs to its request.
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
  std::int64_t duration = 0;   ///< ns, of `wait`
  double period = 0;           ///< ns, of `report`; 0: no more
  std::vector<double> values;  ///< of `set`
};

/// ns: 31 years. Longer ones are refused.
inline constexpr std::int64_t longest_duration = 1'000'000'000'000'000'000;

}  // namespace muro::wire
