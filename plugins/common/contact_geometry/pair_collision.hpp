// SPDX-License-Identifier: MIT
// Common parts of all collision algorithms: which shapes may touch, in which order, and the lists of contacts.
#pragma once

#include <array>
#include <utility>

#include "manifold.hpp"
#include "muro/algorithm.hpp"
#include "muro/toolkit/pair_surface.hpp"
#include "overlap_cache.hpp"
#include "transformed_shape.hpp"

namespace muro::contact_geometry {

inline constexpr PropertyUse collision_reads[] = {
    {"scene.index", "shapes and boxes"},
    {"pose", "of all bodies of robots with shapes"},
    {"contact.world", "of all robots: who resolves their contacts"},
    {"self_collision", "of robots that have it: whether contacts among their links are listed"},
};
inline constexpr PropertyUse collision_writes[] = {{"contacts", "list on the base of every robot that forces move"}};

/// A collider at its present pose.
struct TransformedCollider {
  const Collider* collider = nullptr;
  std::uint32_t number = 0;  ///< in SceneIndex::colliders
  TransformedShape shape;    ///< of a mesh: its bounding box
  Aabb bounds;
};

/// A point in which two robots touch, as seen by the robot that precedes the other.
struct PairPoint {
  std::uint32_t own, other;  ///< colliders
  ContactPoint point;
};

/// Present contacts of a robot. It is reused, so that it stops allocating.
struct Candidates {
  /// Place of a contact in the list, and its numbers.
  struct Listed {
    std::uint64_t body_and_rank;     ///< first collider of the own body; 0: scenery, else index in `robots` plus one
    std::uint64_t body_and_own;      ///< first collider of the other body; own collider
    std::uint64_t other_and_number;  ///< other collider; number among those equal so far, or in `found`
    const double* numbers;           ///< point, normal, depth; null: they are in `found`

    std::uint32_t rank() const { return std::uint32_t(body_and_rank); }
    std::uint32_t own() const { return std::uint32_t(body_and_own); }
    std::uint32_t other() const { return std::uint32_t(other_and_number >> 32); }
    std::uint32_t number() const { return std::uint32_t(other_and_number); }
    bool operator<(const Listed& b) const {
      if (body_and_rank != b.body_and_rank) return body_and_rank < b.body_and_rank;
      if (body_and_own != b.body_and_own) return body_and_own < b.body_and_own;
      return other_and_number < b.other_and_number;
    }
  };
  /// A robot that it touches, which may be itself, and the points of that pair, as the one that precedes sees them.
  struct Partner {
    std::uint32_t robot;
    std::span<const PairPoint> points;
    bool leads;  ///< the robot that has the list precedes
  };
  std::vector<TransformedCollider> own;  ///< bodies in the order of the model, shapes in the order of the body
  std::vector<const TransformedCollider*> others;  ///< of the scenery, as declared
  std::vector<Partner> robots;                     ///< robots that touch it, by order key
  std::vector<Listed> with_scenery, with_robots;
  std::vector<ContactPoint> found;   ///< with scenery
  std::vector<ContactPoint> points;  ///< points of one pair
};

/// Base of the collision algorithms, which provide the narrow phase.
///
/// Phase 0 updates the broad phase. Phases 1 to 3 run while any two robots are near each other. Phase 1 finds which
/// robots are near each other, and how far such robots have moved. Phase 2 places the shapes of those that may touch.
/// Phase 3 computes each pair of robots once, from the side of the one with the lower key. Of two robots only colliders
/// that are close are tested. The others are apart by some distance, and are left out until both robots together have
/// moved that far. In phase 4 each robot that needs it gets its list of contacts, sorted by own body, other body, own
/// shape and other shape: scenery in the order of declaration, then robots in the order of their keys. The robot with
/// the higher key has the contacts of the pair mirrored, so both lists agree to the bit. Lists depend neither on the
/// order in which robots were declared nor on the number of threads. Contacts among the links of a robot
/// (keys::self_collision) are found in phase 4, and are in its list once, like those with another robot. A contact is
/// listed only if the contact algorithm resolves it (contact_responsibility.hpp), or if another algorithm reads the
/// list.
class PairCollision : public Algorithm {
 public:
  void connect(Connector& c) override;
  void start() override;
  std::span<const Phase> phases() const final;
  void step(const Step& step, Range range) final;
  void restored() final { start(); }

 protected:
  struct Robot {
    ListOut<Contact> list;    ///< empty: forces do not move it
    In<std::uint64_t> world;  ///< see keys::contact_world
    std::uint64_t order_key = 0;
    ObjectId base;
    RobotId shadow_of = no_robot;  ///< see keys::shadow_of
    bool has_plane = false;
    bool lists_all = false;       ///< its motion, or the chooser of its motion, reads the list
    std::int32_t own_links = -1;  ///< index in `own_links_`; -1: they never touch each other
  };

  /// Returns the shape of a collider at its present pose. [any thread]
  virtual TransformedShape transformed_shape(std::uint32_t collider) const = 0;
  /// Adds the points in which two colliders with overlapping bounds overlap; normals: from `b` to `a`. [any thread]
  virtual void collide(const TransformedCollider& a, const TransformedCollider& b,
                       std::vector<ContactPoint>& points) = 0;
  /// Returns a lower bound (m) of the distance of two colliders; not positive: unknown, or they touch. [any thread]
  virtual double distance_bound(const TransformedCollider& a, const TransformedCollider& b) const;
  /// Lists the contacts of all robots of a block that have a list.
  virtual void list_contacts(Range robots);

  /// Returns a contact of two shapes without its point, normal and depth.
  Contact contact_between(const Collider& own, const Collider& other) const;
  /// Whether any robot needs contacts; if none does, the algorithm does nothing and `index_` is not connected.
  bool is_needed() const { return is_needed_; }
  /// Finds the scenery that the robot may touch and the robots that it touches, for the calling thread. The result is
  /// valid until the thread's next call. It is empty if nobody needs it.
  Candidates& candidates(std::uint32_t robot);
  /// Replaces the list of the robot by its contacts with these candidates.
  void list_pairs(std::uint32_t robot, Candidates& candidates);
  /// Returns a collider of the robot at its present pose.
  TransformedCollider transformed_collider(std::uint32_t collider) const;
  /// Notes the points in which two colliders touch, for `list_found`. The second is of the scenery. Copies the points.
  void add_found(std::uint32_t own, std::uint32_t other, std::span<const ContactPoint> points,
                 Candidates& candidates) const;
  /// Notes a point in which two colliders touch. The second is of the scenery. `numbers`: point, normal and depth,
  /// which must not change until `list_found`.
  void add_found(std::uint32_t own, std::uint32_t other, const double* numbers, Candidates& candidates) const {
    const auto number = std::uint32_t(candidates.with_scenery.size());
    candidates.with_scenery.push_back(place_of(own, 0, other, number, numbers));
  }
  /// Replaces the list of the robot by its noted contacts with scenery, in any order, and by its contacts with robots.
  void list_found(std::uint32_t robot, Candidates& candidates) const;
  /// Whether the robot touches another robot, or itself, and lists that.
  bool touches_robots(std::uint32_t robot) const;
  /// Whether the list has contacts with scenery.
  bool lists_scenery(const Robot& robot) const;

  In<SceneIndex> index_;
  std::vector<Robot> robots_;                 ///< by number
  std::vector<TransformedCollider> scenery_;  ///< by collider
  std::vector<std::uint32_t> planes_;         ///< colliders of the scenery
  bool robots_have_planes_ = false;
  OverlapCache overlaps_;

 private:
  /// Colliders of two robots that may touch before the robots have moved farther; indices within their robots.
  struct Close {
    std::uint16_t own, other;
  };
  /// Two robots whose fat AABBs overlap.
  struct Pair {
    static constexpr std::size_t most_close = 16;
    std::uint32_t leader = 0, other = 0;  ///< `leader` precedes; equal: no robots so far
    double until = 0;                     ///< m: others touch only after both together have moved farther than this
    bool has_too_many = false;            ///< more are close than fit, so all count as close
    std::uint8_t close_count = 0;
    std::array<Close, most_close> close;
    std::uint32_t first = 0, count = 0;  ///< points of their contact, in `points_` of the leader
  };
  /// A robot that is near the robot that has the list.
  struct Near {
    std::uint32_t robot, pair;  ///< index in `pairs_`
    bool leads;                 ///< the robot that has the list precedes this one
    bool lists;                 ///< the robot that has the list lists contacts with this one
  };

  /// Links of a robot that may touch each other.
  struct OwnLinks {
    In<std::uint32_t> is_wanted;  ///< see keys::self_collision
    std::uint32_t robot = 0;
    std::vector<std::pair<ObjectId, ObjectId>> links;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< colliders of these links
    std::vector<std::pair<std::uint32_t, std::uint32_t>> close;  ///< those of `pairs` that may touch
    double until = 0;               ///< m: other pairs touch only after the robot has moved farther than this
    std::vector<PairPoint> points;  ///< points in which they touch in this step
  };

  bool precedes(std::uint32_t a, std::uint32_t b) const;
  bool has_contacts(const Robot& robot) const;
  bool lists(std::uint32_t robot, std::uint32_t other) const;
  bool are_near(std::uint32_t a, std::uint32_t b) const;
  void find_near_robots(std::uint32_t robot);
  void follow(std::uint32_t robot, std::uint64_t step);
  bool is_known(const Pair& pair, std::uint32_t leader, std::uint32_t other) const {
    return pair.leader == leader && pair.other == other && travel_[leader] + travel_[other] < pair.until;
  }
  bool may_touch(std::uint32_t robot, Near& near) const;
  void place_colliders(std::uint32_t robot);
  void place(std::uint32_t collider);
  /// Whether a collider, of a robot that may touch another, has been placed.
  bool is_placed(std::uint32_t collider) const { return is_placed_[collider] != 0; }
  void collide_pair(std::uint32_t robot, const Near& near);
  void collide_all(const Pair& pair);
  void collide_two(const TransformedCollider& a, const TransformedCollider& b, std::vector<PairPoint>& found);
  bool touch(const Near& near) const { return pairs_[near.pair].count > 0; }
  void find_close(Pair& pair) const;
  void connect_own_links(Connector& c, const RobotView& view);
  void start_own_links();
  void collide_own_links(OwnLinks& own, std::uint64_t step);
  void find_close(OwnLinks& own);
  /// Returns the points in which links of the robot touch each other.
  std::span<const PairPoint> own_points(std::uint32_t robot) const {
    const std::int32_t own = robots_[robot].own_links;
    return own < 0 ? std::span<const PairPoint>() : own_links_[std::size_t(own)].points;
  }
  void add_scenery(const OverlapCache::Overlaps& overlaps, const Aabb& bounds, Candidates& candidates) const;
  template <class Sink>
  void collide_scenery(Candidates& candidates, Sink sink);
  Candidates::Listed place_of(std::uint32_t own, std::uint32_t rank, std::uint32_t other, std::uint32_t number,
                              const double* numbers) const {
    const auto both = [](std::uint32_t high, std::uint32_t low) { return std::uint64_t(high) << 32 | low; };
    return {both(first_of_body_[own], rank), both(first_of_body_[other], own), both(other, number), numbers};
  }
  void add_listed(std::uint32_t robot, std::uint32_t rank, Candidates& candidates) const;
  bool has_places(const Contact& contact, const Candidates::Listed& listed) const;
  static void write_numbers(const Candidates::Listed& listed, const Candidates& candidates, Contact& contact);
  bool update_list(std::span<Contact> list, const Candidates& candidates) const;
  void write_list(const ListOut<Contact>& list, Candidates& candidates) const;

  std::uint8_t is_crowded_ = 0;      ///< some two robots may be near each other
  std::uint8_t is_anyone_near_ = 0;  ///< some two robots are near each other
  const Phase all_phases_[5] = {
      {Phase::IndexSpace::whole},
      {.index_space = Phase::IndexSpace::robots, .scope = Phase::Scope::own_robot, .enabled = &is_crowded_},
      {.index_space = Phase::IndexSpace::robots, .enabled = &is_anyone_near_},
      {.index_space = Phase::IndexSpace::robots, .enabled = &is_anyone_near_},
      {.index_space = Phase::IndexSpace::robots}};
  std::vector<Pair> pairs_;                     ///< by number of the pair
  std::vector<std::vector<PairPoint>> points_;  ///< by robot: points in which it touches those that it precedes
  /// Robots whose bounds overlap those of a robot, while any two may be near; from phase 2 on those that it may touch.
  std::vector<std::vector<Near>> near_;
  std::vector<double> travel_;                ///< by robot, m: an upper bound of how far its shapes have moved in total
  std::vector<double> last_move_;             ///< by robot, m: in the last step; 0 if that is unknown
  std::vector<std::uint64_t> followed_in_;    ///< by robot: last step of follow()
  std::vector<Pose> followed_;                ///< by collider, first one of each body: pose of the body then
  std::vector<TransformedCollider> placed_;   ///< by collider
  std::vector<std::uint8_t> is_placed_;       ///< by collider, for robots that may touch others in this step
  std::vector<double> radii_;                 ///< by collider, m: of a ball about the origin of its body that holds it
  std::vector<std::uint32_t> first_of_body_;  ///< by collider: first collider of its body
  std::vector<OwnLinks> own_links_;           ///< of robots whose links may touch each other
  bool is_needed_ = false;
  FrictionRule friction_rule_ = FrictionRule::min;
};

}  // namespace muro::contact_geometry
