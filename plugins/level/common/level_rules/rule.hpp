// SPDX-License-Identifier: MIT
// Rules that decide when another motion moves a robot, as a user writes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace muro::level {

/// One rule: "near when nearer than 2 to ball".
struct Rule {
  enum class When : std::uint8_t {
    at,              ///< NAME at SECONDS
    nearer,          ///< NAME when nearer than METRES to WHAT: a robot, an object or a place; or to any robot
    farther,         ///< NAME when farther than METRES from WHAT, or from all robots
    inside,          ///< NAME when inside PLACE
    outside,         ///< NAME when outside PLACE
    in_contact,      ///< NAME when in contact: with another robot
    out_of_contact,  ///< NAME when out of contact for SECONDS
    slower,          ///< NAME when slower than FACTOR: the run, in units of real time
    faster,          ///< NAME when faster than FACTOR
  };
  std::uint32_t level = 0;  ///< index in the list of names
  When when = When::at;
  double number = 0;  ///< s, m or 1
  std::string what;   ///< empty: any or all robots

  bool by_distance() const { return when == When::nearer || when == When::farther; }
  bool by_place() const { return when == When::inside || when == When::outside; }
  bool by_contact() const { return when == When::in_contact || when == When::out_of_contact; }
  bool by_run_speed() const { return when == When::slower || when == When::faster; }
};

/// Parses a rule. Throws Error that says what is allowed. `names`: names of the robot's motions.
Rule parse_rule(std::string_view text, std::span<const std::string> names);

}  // namespace muro::level
