// SPDX-License-Identifier: MIT
// Places of the other players, as a player believes them, and ways to walk that avoid them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "../common/place.hpp"

namespace soccer {

using examples::Point;

/// Mates and opponents that were seen or reported a short time ago.
class Others {
 public:
  static constexpr double remembers = 2;  ///< s

  struct Other {
    Point at;          ///< m, on the field
    double age = 1e3;  ///< s
    bool is_there() const { return age < remembers; }
  };

  void pass(double seconds) {
    for (Other& o : all_) o.age += seconds;
  }
  /// Notes a player at a place now: the known one that was nearest to it, or else the one seen the longest time ago.
  void see(const Point& at) {
    constexpr double same = 0.5;  // m
    const Other* const near = nearest(at, same);
    Other& who = near ? all_[std::size_t(near - all_.data())] : *std::ranges::max_element(all_, {}, &Other::age);
    who = {at, 0};
  }

  /// Returns whether nobody is nearer than `keep` (m) to the straight way from `from` to `to`.
  bool is_free(const Point& from, const Point& to, double keep) const { return !first_on(from, to, keep); }
  /// Returns the player nearest to a point; null when all are farther away than `within` (m).
  const Other* nearest(const Point& to, double within) const {
    const Other* best = nullptr;
    for (const Other& o : all_)
      if (o.is_there() && (o.at - to).norm() < within) best = &o, within = (o.at - to).norm();
    return best;
  }
  /// Returns the point to walk to first, so as to reach `to` at a distance of `keep` (m) from everybody.
  Point detour(const Point& from, const Point& to, double keep) const {
    const Other* const first = first_on(from, to, keep);
    return first ? beside(first->at, from, to, keep) : to;
  }
  /// Returns a point beside an obstacle, on the side on which the way passes it. It is a fifth farther away than `keep`
  /// (m), so that the way to it keeps the distance, too.
  static Point beside(const Point& obstacle, const Point& from, const Point& to, double keep) {
    const Line way(from, to);
    return obstacle + (way.left_of(obstacle) > 0 ? -1.2 * keep : 1.2 * keep) * way.normal;
  }
  /// Returns whether an obstacle is in the way.
  static bool blocks(const Point& obstacle, const Point& from, const Point& to, double keep) {
    const Line way(from, to);
    return way.along(obstacle) > 0 && way.along(obstacle) < way.length && std::abs(way.left_of(obstacle)) < keep;
  }

 private:
  struct Line {
    Point from, direction{1, 0}, normal{0, 1};
    double length;

    Line(const Point& a, const Point& b) : from(a), length((b - a).norm()) {
      if (length > 1e-9) direction = (1 / length) * (b - a);
      normal = {-direction.y, direction.x};
    }
    double along(const Point& p) const { return dot(p - from, direction); }
    double left_of(const Point& p) const { return dot(p - from, normal); }
  };

  const Other* first_on(const Point& from, const Point& to, double keep) const {
    const Line way(from, to);
    const Other* first = nullptr;
    for (const Other& o : all_)
      if (o.is_there() && blocks(o.at, from, to, keep) && (!first || way.along(o.at) < way.along(first->at)))
        first = &o;
    return first;
  }

  std::array<Other, 8> all_;
};

}  // namespace soccer
