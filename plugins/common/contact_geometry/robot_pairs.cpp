// SPDX-License-Identifier: MIT
// Pairs of robots: which are near each other, which may touch, and where they do.
#include <algorithm>
#include <cmath>
#include <limits>

#include "box_gap.hpp"
#include "pair_collision.hpp"

namespace muro::contact_geometry {

/// Whether two robots are near each other. A plane reaches everyone.
bool PairCollision::are_near(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].has_plane || robots_[b].has_plane || index_->robots[a].bounds.overlaps(index_->robots[b].bounds);
}

/// Finds the near robots, in any order.
void PairCollision::find_near_robots(std::uint32_t robot) {
  std::vector<Near>& near = near_[robot];
  near.clear();
  for (const OverlapCache::Overlap& overlap : overlaps_.robots_of(robot))
    if (are_near(robot, overlap.robot))
      near.push_back({overlap.robot, overlap.pair, precedes(robot, overlap.robot), false});
}

/// Adds an upper bound of how far the robot has moved since the last time: for each body the way of its origin, and the
/// way of the rest by turning. The sum of two lengths is at most the root of twice the sum of their squares.
void PairCollision::follow(std::uint32_t robot, std::uint64_t step) {
  const RobotColliders& colliders = index_->robots[robot];
  const std::uint32_t end = colliders.first + colliders.count;
  double farthest2 = 0;
  for (std::uint32_t k = colliders.first; k < end;) {
    const Pose& now = *index_->colliders[k].body_pose;
    Pose& then = followed_[k];
    double radius = 0;
    for (const std::uint32_t body = k; k < end && first_of_body_[k] == body; ++k) radius = std::max(radius, radii_[k]);
    const auto &q = now.orientation.coeffs(), &p = then.orientation.coeffs();
    const double turned2 = std::min((q - p).squaredNorm(), (q + p).squaredNorm());  // (2 sin(angle / 4))^2
    const double by_turning2 = turned2 > 0 ? 4 * turned2 * radius * radius : 0;     // a plane has no radius
    farthest2 = std::max(farthest2, 2 * ((now.position - then.position).squaredNorm() + by_turning2));
    then = now;
  }
  const double farthest = std::sqrt(farthest2);
  last_move_[robot] = followed_in_[robot] + 1 == step ? farthest : 0;
  followed_in_[robot] = step;
  travel_[robot] += farthest;
}

/// Whether contacts of a pair are of interest, and it is not known to be apart.
bool PairCollision::may_touch(std::uint32_t robot, Near& near) const {
  const Pair& pair = pairs_[near.pair];
  const std::uint32_t leader = near.leads ? robot : near.robot, other = near.leads ? near.robot : robot;
  if (pair.close_count == 0 && !pair.has_too_many && is_known(pair, leader, other)) return false;
  near.lists = lists(robot, near.robot);
  return near.lists || lists(near.robot, robot);
}

void PairCollision::place(std::uint32_t collider) {
  if (is_placed_[collider] != 0) return;
  placed_[collider] = transformed_collider(collider);
  is_placed_[collider] = 1;
}

/// Places the colliders that are close to a near robot, or all if that is unknown. Forgets robots that it cannot touch.
void PairCollision::place_colliders(std::uint32_t robot) {
  std::vector<Near>& others = near_[robot];
  if (others.empty()) return;
  std::erase_if(others, [&](Near& near) { return !may_touch(robot, near); });
  if (others.empty()) return;
  const RobotColliders& colliders = index_->robots[robot];
  const std::uint32_t end = colliders.first + colliders.count;
  std::fill(is_placed_.begin() + colliders.first, is_placed_.begin() + end, std::uint8_t{0});
  for (const Near& near : others) {
    const Pair& pair = pairs_[near.pair];
    if (pair.has_too_many || !is_known(pair, near.leads ? robot : near.robot, near.leads ? near.robot : robot)) {
      for (std::uint32_t k = colliders.first; k < end; ++k) place(k);
      return;
    }
    for (const Close& close : std::span(pair.close).first(pair.close_count))
      place(colliders.first + (near.leads ? close.own : close.other));
  }
}

/// Collides a robot with another one that it precedes.
void PairCollision::collide_pair(std::uint32_t robot, const Near& near) {
  Pair& pair = pairs_[near.pair];
  std::vector<PairPoint>& found = points_[robot];
  pair.first = std::uint32_t(found.size());
  if (!is_known(pair, robot, near.robot)) {
    pair.leader = robot;
    pair.other = near.robot;
    find_close(pair);
  }
  if (pair.has_too_many) {
    collide_all(pair);
  } else {
    const std::uint32_t mine = index_->robots[robot].first, theirs = index_->robots[near.robot].first;
    for (const Close& close : std::span(pair.close).first(pair.close_count))
      collide_two(placed_[mine + close.own], placed_[theirs + close.other], found);
  }
  pair.count = std::uint32_t(found.size()) - pair.first;
}

void PairCollision::collide_all(const Pair& pair) {
  const RobotColliders &mine = index_->robots[pair.leader], &theirs = index_->robots[pair.other];
  for (std::uint32_t k = mine.first; k < mine.first + mine.count; ++k)
    for (std::uint32_t m = theirs.first; m < theirs.first + theirs.count; ++m)
      if (placed_[k].shape.kind != ShapeKind::plane || placed_[m].shape.kind != ShapeKind::plane)
        collide_two(placed_[k], placed_[m], points_[pair.leader]);
}

void PairCollision::collide_two(const TransformedCollider& a, const TransformedCollider& b,
                                std::vector<PairPoint>& found) {
  thread_local std::vector<ContactPoint> points;
  if (!a.bounds.overlaps(b.bounds)) return;
  points.clear();
  collide(a, b, points);
  for (const ContactPoint& p : points) found.push_back({a.number, b.number, p});
}

double PairCollision::distance_bound(const TransformedCollider& a, const TransformedCollider& b) const {
  return gap_between(a.bounds, b.bounds);
}

/// Finds the colliders that are closer than the two robots move in some steps, judged by the last step. All colliders
/// of both robots must have been placed.
void PairCollision::find_close(Pair& pair) const {
  constexpr double steps = 16, least = 1e-4;  // -, m
  const RobotColliders &mine = index_->robots[pair.leader], &theirs = index_->robots[pair.other];
  pair.close_count = 0;
  pair.has_too_many = robots_[pair.leader].has_plane || robots_[pair.other].has_plane ||
                      std::max(mine.count, theirs.count) > std::numeric_limits<std::uint16_t>::max();
  const double margin = steps * (last_move_[pair.leader] + last_move_[pair.other]) + least;
  double distance = std::numeric_limits<double>::infinity();  // of those that are not close
  for (std::uint32_t k = mine.first; k < mine.first + mine.count && !pair.has_too_many; ++k) {
    const TransformedCollider& a = placed_[k];
    if (const double gap = gap_between(a.bounds, theirs.bounds); gap > margin) {
      distance = std::min(distance, gap);
      continue;
    }
    for (std::uint32_t m = theirs.first; m < theirs.first + theirs.count; ++m) {
      const TransformedCollider& b = placed_[m];
      double apart = gap_between(a.bounds, b.bounds);
      if (apart <= margin) apart = std::max(apart, distance_bound(a, b));
      if (apart > margin)
        distance = std::min(distance, apart);
      else if (pair.close_count == Pair::most_close)
        pair.has_too_many = true;
      else
        pair.close[pair.close_count++] = {std::uint16_t(k - mine.first), std::uint16_t(m - theirs.first)};
    }
  }
  const Aabb& bounds = mine.bounds;
  const double rounding = 1e-14 * std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
  if (pair.has_too_many) distance = margin;
  pair.until = travel_[pair.leader] + travel_[pair.other] + distance - rounding - 1e-9;
}

bool PairCollision::touches_robots(std::uint32_t robot) const {
  if (!own_points(robot).empty()) return true;
  return is_anyone_near_ != 0 && std::any_of(near_[robot].begin(), near_[robot].end(),
                                             [&](const Near& near) { return near.lists && touch(near); });
}

}  // namespace muro::contact_geometry
