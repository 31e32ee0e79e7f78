// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "segment.hpp"

namespace muro::line_of_sight {

/// Boxes around one point, sorted by the directions in which they lie, seen from above. It is for many lines that begin
/// in this point, so that each line tests only few boxes. It is not usable if there are too many boxes.
class Fan {
 public:
  static constexpr std::size_t most_boxes = 1024;

  /// For lines from `centre` (m, world), of which robot `own` (or no_robot) is no obstacle. [step]
  void begin(const Vec3& centre, RobotId own);
  /// A box around an obstacle, and a number by which `any` names it. Returns whether the fan is still usable.
  bool add(const Aabb& box, std::uint32_t item) {
    usable_ = boxes_.size() < most_boxes;
    if (usable_) boxes_.push_back({box, item});
    return usable_;
  }
  /// Ends the list of boxes. [after the last one, before lines]
  void close();
  void give_up() { usable_ = false; }

  const Vec3& centre() const { return centre_; }
  RobotId own() const { return own_; }
  bool is_usable() const { return usable_; }
  /// Calls visit(item) for boxes that the segment touches, until one call returns true. Returns whether one did. The
  /// segment goes from `centre` to `to` or the other way.
  template <class Visit>
  bool any(const Vec3& to, const Segment& segment, Visit visit) const {
    const std::uint64_t* const seen = &seen_[sector_of(to - centre_) * words_];
    for (std::size_t w = 0; w < words_; ++w)
      for (std::uint64_t bits = seen[w]; bits != 0; bits &= bits - 1) {
        const Entry& e = boxes_[64 * w + std::size_t(std::countr_zero(bits))];
        if (segment.touches(e.box) && visit(e.item)) return true;
      }
    return false;
  }

 private:
  static constexpr int sectors = 128;
  struct Entry {
    Aabb box;
    std::uint32_t item;
  };
  /// Returns a number from -2 to 2 that grows with the bearing of (x, y), by 2 in half a turn.
  static double diamond_angle(double x, double y);
  static std::size_t sector_of(const Vec3& direction);
  void mark(std::size_t box);

  Vec3 centre_ = Vec3::Zero();
  RobotId own_ = no_robot;
  bool usable_ = true;
  std::vector<Entry> boxes_;
  std::size_t words_ = 0;                                          ///< words of 64 boxes, for each sector
  std::array<std::uint64_t, sectors* most_boxes / 64> seen_ = {};  ///< by sector: a bit for each box
};

}  // namespace muro::line_of_sight
