// SPDX-License-Identifier: MIT
// Converts the joints of a robot, as its model has them, to the angles of legs and back: order, directions and zeros.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "../common/vector.hpp"
#include "gait.hpp"
#include "muro_controller.hpp"
#include "words.hpp"

namespace quadruped {

using examples::Vector;

inline constexpr int joints_of_leg = 3, joints = legs * joints_of_leg;

/// Returns the error for a wrong argument in the scenario.
inline std::invalid_argument complaint(std::string_view argument, std::string_view text, const std::string& allowed) {
  return std::invalid_argument("argument `" + std::string(argument) + "` is \"" + std::string(text) + "\"; it is " +
                               allowed);
}

/// Converts the joints of the robot, as they are connected, to the angles of `Leg`.
struct JointMap {
  std::array<int, legs> place{0, 1, 2, 3};  ///< places of the joints of front left, front right, ... in the connection
  std::array<double, joints> sign, offset;  ///< by place: angle = sign * position + offset, rad

  explicit JointMap(const muro::controller::Setup& setup) {
    sign.fill(1), offset.fill(0);
    const std::string_view order = setup.argument("legs", "FL FR RL RR");
    read_order(order);
    read_numbers("signs", setup.argument("signs"), sign);
    read_numbers("offsets", setup.argument("offsets"), offset);
    for (const double s : sign)
      if (std::abs(s) != 1) throw complaint("signs", setup.argument("signs"), "12 times 1 or -1");
  }
  std::size_t at(int leg, int joint) const { return std::size_t(place[std::size_t(leg)] * joints_of_leg + joint); }
  Vector angles(int leg, std::span<const double> positions) const {
    const auto a = [&](int j) { return sign[at(leg, j)] * positions[at(leg, j)] + offset[at(leg, j)]; };
    return {a(0), a(1), a(2)};
  }
  Vector rates(int leg, std::span<const double> velocities) const {
    const auto r = [&](int j) { return sign[at(leg, j)] * velocities[at(leg, j)]; };
    return {r(0), r(1), r(2)};
  }

 private:
  void read_order(std::string_view text) {
    constexpr std::string_view names[] = {"FL", "FR", "RL", "RR"};
    const std::string allowed = "FL, FR, RL and RR, each once, in the order in which their joints are connected";
    int seen = 0, count = 0;
    for_words(text, [&](std::string_view word) {
      const auto* const name = std::find(std::begin(names), std::end(names), word);
      if (name == std::end(names) || count >= legs) throw complaint("legs", text, allowed);
      place[std::size_t(name - names)] = count++;
      seen |= 1 << (name - names);
    });
    if (seen != 15) throw complaint("legs", text, allowed);
  }
  static void read_numbers(std::string_view argument, std::string_view text, std::array<double, joints>& to) {
    if (text.empty()) return;
    const std::string allowed = "12 numbers, in the order in which the joints are connected";
    std::size_t count = 0;
    for_words(text, [&](std::string_view word) {
      if (count == joints) throw complaint(argument, text, allowed);
      const std::optional<double> number = number_of(word);
      if (!number) throw complaint(argument, text, allowed);
      to[count++] = *number;
    });
    if (count != joints) throw complaint(argument, text, allowed);
  }
};

}  // namespace quadruped
