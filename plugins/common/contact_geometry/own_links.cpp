// SPDX-License-Identifier: MIT
// Contacts among the links of one robot, for motions that resolve them (keys::self_collision).
#include <algorithm>
#include <limits>

#include "box_gap.hpp"
#include "link_bodies.hpp"
#include "pair_collision.hpp"

namespace muro::contact_geometry {
namespace {

constexpr std::size_t some_points = 64;

bool is_ground(const Collider& c) { return c.shape->kind == ShapeKind::plane || c.shape->kind == ShapeKind::heightmap; }

}  // namespace

/// Connects the links of a robot with a list.
void PairCollision::connect_own_links(Connector& c, const RobotView& view) {
  if (!c.is_used(view.base(), keys::self_collision, usage::variable)) return;
  OwnLinks& own = own_links_.emplace_back();
  own.is_wanted = c.read(view.base(), keys::self_collision);
  own.robot = index_of(view.id);
  const LinkBodies bodies(view);
  for (std::uint32_t a = 0; a < view.links.size(); ++a)
    for (std::uint32_t b = a + 1; b < view.links.size(); ++b)
      if (bodies.may_touch(a, b)) own.links.emplace_back(std::minmax(view.links[a].object, view.links[b].object));
  std::sort(own.links.begin(), own.links.end());
  robots_[index_of(view.id)].own_links = std::int32_t(own_links_.size()) - 1;
}

/// Finds the colliders that may touch, and allocates the memory that steps need.
void PairCollision::start_own_links() {
  for (OwnLinks& own : own_links_) {
    own.pairs.clear();
    const RobotColliders& colliders = index_->robots[own.robot];
    const std::uint32_t end = colliders.first + colliders.count;
    for (std::uint32_t a = colliders.first; a < end; ++a)
      for (std::uint32_t b = a + 1; b < end; ++b) {
        const Collider &first = index_->colliders[a], &second = index_->colliders[b];
        if (is_ground(first) || is_ground(second)) continue;
        const std::pair<ObjectId, ObjectId> links = std::minmax(first.body, second.body);
        if (std::binary_search(own.links.begin(), own.links.end(), links)) own.pairs.emplace_back(a, b);
      }
    own.close.clear();
    own.close.reserve(own.pairs.size());
    own.until = -1;
    own.points.clear();
    own.points.reserve(some_points);
    const ListOut<Contact>& list = robots_[own.robot].list;
    for (std::size_t i = 0; i < some_points; ++i) list.push_back({});
    list.clear();
  }
}

void PairCollision::collide_own_links(OwnLinks& own, std::uint64_t step) {
  own.points.clear();
  if (*own.is_wanted == 0 || !has_contacts(robots_[own.robot])) return;
  if (followed_in_[own.robot] != step) follow(own.robot, step);
  const RobotColliders& colliders = index_->robots[own.robot];
  std::fill_n(is_placed_.begin() + colliders.first, colliders.count, std::uint8_t{0});
  if (travel_[own.robot] >= own.until) find_close(own);
  for (const auto& [a, b] : own.close) {
    place(a), place(b);
    collide_two(placed_[a], placed_[b], own.points);
  }
}

/// Finds the colliders that are closer than links approach each other in some steps, judged by the last step.
void PairCollision::find_close(OwnLinks& own) {
  constexpr double steps = 16, least = 1e-3;  // -, m
  const RobotColliders& colliders = index_->robots[own.robot];
  for (std::uint32_t k = colliders.first; k < colliders.first + colliders.count; ++k) place(k);
  const double margin = 2 * steps * last_move_[own.robot] + least;
  double distance = std::numeric_limits<double>::infinity();  // of those that are not close
  own.close.clear();
  for (const auto& [a, b] : own.pairs) {
    double apart = gap_between(placed_[a].bounds, placed_[b].bounds);
    if (apart <= margin) apart = std::max(apart, distance_bound(placed_[a], placed_[b]));
    if (apart > margin)
      distance = std::min(distance, apart);
    else
      own.close.emplace_back(a, b);
  }
  const Aabb& bounds = colliders.bounds;
  const double rounding = 1e-14 * std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
  own.until = travel_[own.robot] + 0.5 * (distance - rounding - 1e-9);
}

}  // namespace muro::contact_geometry
