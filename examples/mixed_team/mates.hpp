// SPDX-License-Identifier: MIT
// Messages of the mates, and the right to a target: a robot takes the nearest one that no mate claims.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "message.hpp"

namespace mixed_team {

struct Mate {
  std::int64_t name = -1;
  double heard = -1e9;  ///< s: time of its last message
  Point at;             ///< m
  std::int64_t claims = 0;
  Point claim;  ///< m: place of the target that it claims
  double cost = 0;
};

class Mates {
 public:
  static constexpr std::size_t most = 16;
  static constexpr double forgotten = 3;  ///< s: a mate that was not heard for so long claims nothing any more

  void hear(const Message& m, double time) {
    Mate* place = &mates_[0];
    for (Mate& mate : mates_) {
      if (mate.name == m.name) {
        place = &mate;
        break;
      }
      if (mate.heard < place->heard) place = &mate;
    }
    *place = {m.name, time, m.at, m.claim != Targets::none, m.claim != Targets::none ? m.targets[m.claim].at : Point{},
              m.cost};
  }
  /// Returns whether a mate has a better right to a target than this robot, which could be there in `cost` s. `claims`:
  /// it claims the target already. Claims hold; of two robots with the same claim the nearer one has it.
  bool hold(const Target& t, double time, double cost, std::int64_t name, bool claims) const {
    for (const Mate& m : mates_) {
      if (time - m.heard > forgotten || m.claims == 0 || distance(m.claim, t.at) > Targets::same) continue;
      const double told = std::floor(std::min(cost, 255.0));  // rounded as in a message
      if (!claims || m.cost < told || (m.cost == told && m.name < name)) return true;
    }
    return false;
  }
  auto begin() const { return mates_.begin(); }
  auto end() const { return mates_.end(); }

 private:
  std::array<Mate, most> mates_{};
};

}  // namespace mixed_team
