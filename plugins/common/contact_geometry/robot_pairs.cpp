// SPDX-License-Identifier: MIT
// Pairs of robots: who is near whom, who may touch, and where they do.
#include <algorithm>
#include <cmath>
#include <limits>

#include "pair_collision.hpp"

namespace muro::contact_geometry {
namespace {

/// A distance (m) that two boxes are apart at least; negative where they overlap.
double gap_between(const Aabb& a, const Aabb& b) {
  return std::max((a.low - b.high).maxCoeff(), (b.low - a.high).maxCoeff());
}

}  // namespace

/// A plane reaches everyone.
bool PairCollision::are_near(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].has_plane || robots_[b].has_plane || index_->robots[a].bounds.overlaps(index_->robots[b].bounds);
}

/// In any order.
void PairCollision::find_near_robots(std::uint32_t robot) {
  std::vector<std::uint32_t>& near = near_[robot];
  near.clear();
  if (!robots_have_planes_) {
    for (const std::uint32_t other : overlaps_.robots_of(robot))
      if (are_near(robot, other)) near.push_back(other);
    return;
  }
  for (std::uint32_t other = 0; other < robots_.size(); ++other)
    if (other != robot && are_near(robot, other)) near.push_back(other);
}

/// Adds how far the robot has moved since the last time, at most: of each body its origin, and the rest by turning. Of
/// two lengths the sum is at most the root of twice the sum of their squares.
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
bool PairCollision::may_touch(std::uint32_t a, std::uint32_t b) const {
  const bool a_leads = precedes(a, b);
  const std::uint32_t other = a_leads ? b : a;
  for (const Apart& apart : led_[a_leads ? a : b].apart)
    if (apart.robot == other && apart.is_apart && travel_[a] + travel_[b] < apart.until) return false;
  return lists(a, b) || lists(b, a);
}

/// Those that may touch a near robot, as far as the balls around them tell; the bounds of the others are empty. Forgets
/// near robots that it cannot touch.
void PairCollision::place_colliders(std::uint32_t robot) {
  std::vector<std::uint32_t>& others = near_[robot];
  std::erase_if(others, [&](std::uint32_t other) { return !may_touch(robot, other); });
  if (others.empty()) return;
  const RobotColliders& colliders = index_->robots[robot];
  for (std::uint32_t k = colliders.first; k < colliders.first + colliders.count; ++k) {
    const Vec3& centre = index_->colliders[k].body_pose->position;
    const Vec3 radius = Vec3::Constant(radii_[k]);
    const Aabb ball{centre - radius, centre + radius};
    const bool is_near = std::any_of(others.begin(), others.end(), [&](std::uint32_t other) {
      return robots_[other].has_plane || index_->robots[other].bounds.overlaps(ball);
    });
    if (is_near)
      placed_[k] = transformed_collider(k);
    else
      placed_[k].bounds = {};
  }
}

void PairCollision::collide_pair(std::uint32_t robot, std::uint32_t other, Led& led) {
  thread_local std::vector<const TransformedCollider*> theirs;
  thread_local std::vector<ContactPoint> points;
  const RobotColliders &mine = index_->robots[robot], &of_other = index_->robots[other];
  const auto first = std::uint32_t(led.points.size());
  theirs.clear();
  const bool any_plane = robots_[robot].has_plane || robots_[other].has_plane;
  for (std::uint32_t k = of_other.first; k < of_other.first + of_other.count; ++k)
    if (any_plane || placed_[k].bounds.overlaps(mine.bounds)) theirs.push_back(&placed_[k]);
  for (std::uint32_t k = mine.first; k < mine.first + mine.count; ++k) {
    const TransformedCollider& a = placed_[k];
    if (!any_plane && !a.bounds.overlaps(of_other.bounds)) continue;
    for (const TransformedCollider* b : theirs) {
      if (!a.bounds.overlaps(b->bounds)) continue;
      if (a.shape.kind == ShapeKind::plane && b->shape.kind == ShapeKind::plane) continue;
      points.clear();
      collide(a, *b, points);
      for (const ContactPoint& p : points) led.points.push_back({k, b->number, p});
    }
  }
  if (const auto count = std::uint32_t(led.points.size()) - first; count > 0)
    led.pairs.push_back({other, first, count});
  if (!any_plane) note_distance(robot, other, led);
}

double PairCollision::distance_bound(const TransformedCollider& a, const TransformedCollider& b) const {
  return gap_between(a.bounds, b.bounds);
}

/// How far (m) two robots are apart at least; not positive: unknown, or they touch.
double PairCollision::robot_distance(std::uint32_t robot, std::uint32_t other) const {
  thread_local std::vector<TransformedCollider> theirs;
  const RobotColliders &mine = index_->robots[robot], &of_other = index_->robots[other];
  theirs.clear();
  for (std::uint32_t k = of_other.first; k < of_other.first + of_other.count; ++k)
    theirs.push_back(transformed_collider(k));
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t k = mine.first; k < mine.first + mine.count && least > 0; ++k) {
    const TransformedCollider a = transformed_collider(k);
    for (const TransformedCollider& b : theirs) {
      const double gap = gap_between(a.bounds, b.bounds);
      if (gap >= least) continue;
      least = std::min(least, std::max(gap, distance_bound(a, b)));
    }
  }
  return least;
}

/// After a pair has been computed. Its distance is measured where that saves several steps of work, as far as the last
/// step tells.
void PairCollision::note_distance(std::uint32_t robot, std::uint32_t other, Led& led) const {
  constexpr double steps = 8, least_distance = 1e-6, retry = 1e-4;  // -, m, m
  const double travel = travel_[robot] + travel_[other], ahead = steps * (last_move_[robot] + last_move_[other]);
  auto at = std::find_if(led.apart.begin(), led.apart.end(), [&](const Apart& a) { return a.robot == other; });
  if (at != led.apart.end() && !at->is_apart && travel < at->until) return;
  double distance = 0;
  if (led.pairs.empty() || led.pairs.back().robot != other) {
    const Aabb& bounds = index_->robots[robot].bounds;
    const double rounding = 1e-14 * std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
    distance = robot_distance(robot, other) - rounding - 1e-9;
  }
  if (at == led.apart.end()) {
    if (led.apart.size() == Led::most_apart) led.apart.erase(led.apart.begin());
    at = led.apart.insert(led.apart.end(), Apart{});
  }
  const bool is_apart = distance > ahead + least_distance;
  *at = {other, is_apart, travel + (is_apart ? distance : ahead + retry)};
}

/// Null: the two do not touch.
const PairCollision::Led::Pair* PairCollision::pair_of(std::uint32_t robot, std::uint32_t other) const {
  const bool leads = precedes(robot, other);
  for (const Led::Pair& p : led_[leads ? robot : other].pairs)
    if (p.robot == (leads ? other : robot)) return &p;
  return nullptr;
}

bool PairCollision::touches_robots(std::uint32_t robot) const {
  return is_anyone_near_ != 0 && std::any_of(near_[robot].begin(), near_[robot].end(), [&](std::uint32_t other) {
           return pair_of(robot, other) != nullptr && lists(robot, other);
         });
}

}  // namespace muro::contact_geometry
